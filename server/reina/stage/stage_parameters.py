"""The parameters of stage, camera, lights and note blocks.

The resting state is a band room after school: a low sun through tall windows at the player's right, a cool
room around, a thin light from behind. Axes are metres, +Y up, the player at the origin faces +Z, her right
hand is at -X. A light's intensity is its irradiance at the player where π brings a white surface that faces
it to 1 before exposure.
"""

from reina.curves.parameter import Parameter
from reina.curves.parameter_registry import ParameterRegistry
from reina.stage.light_parameters import LIGHT_PARAMETERS

ARRANGEMENTS = ("toward_bell", "lane_below")
STYLES = ("physical", "toon")
FINISHES = ("lacquer", "silver")

STAGE_PARAMETERS: tuple[Parameter, ...] = (
    Parameter(
        "camera/position",
        "vector",
        (-1.62, 1.56, 2.4),
        unit="m",
        minimum=-50.0,
        maximum=50.0,
        documentation="Where the camera stands.",
    ),
    Parameter(
        "camera/target",
        "vector",
        (0.06, 1.29, 0.28),
        unit="m",
        minimum=-50.0,
        maximum=50.0,
        documentation="The point it looks at, in the middle of the picture.",
    ),
    Parameter(
        "camera/fov",
        "number",
        0.5,
        unit="rad",
        minimum=0.05,
        maximum=2.0,
        documentation="Vertical angle of view at 16:9: 0.56 is a 35 mm lens, 0.40 a 50, 0.24 an 85.",
    ),
    Parameter(
        "camera/roll",
        "number",
        0.0,
        unit="rad",
        minimum=-3.1416,
        maximum=3.1416,
        documentation="Turn about the line of sight; positive tips the picture's top to the left.",
    ),
    Parameter(
        "camera/focus_distance",
        "number",
        0.0,
        unit="m",
        minimum=0.0,
        maximum=100.0,
        documentation="How far from the camera it is sharp; 0 is at the camera's target.",
    ),
    Parameter(
        "camera/aperture",
        "number",
        0.0,
        unit="m",
        minimum=0.0,
        maximum=0.2,
        documentation="Width of the lens's opening: 0 has all in focus, 0.025 is a 50 mm lens at f/2.",
    ),
    *LIGHT_PARAMETERS,
    Parameter(
        "stage/exposure",
        "number",
        1.0,
        minimum=0.0,
        maximum=10.0,
        documentation="Brightness of the whole picture, before tone mapping.",
    ),
    Parameter(
        "stage/bloom/strength",
        "number",
        0.35,
        minimum=0.0,
        maximum=4.0,
        documentation="How much of what is brightest spills over its edges.",
    ),
    Parameter(
        "stage/bloom/threshold",
        "number",
        1.0,
        minimum=0.0,
        maximum=10.0,
        documentation="From which brightness on light spills over; 1 is a white surface in full light.",
    ),
    Parameter("stage/background", "color", "#1B1714", documentation="Colour of the air behind everything."),
    Parameter("stage/floor_color", "color", "#3A2A1E", documentation="Colour of the floor."),
    Parameter(
        "stage/fog/density",
        "number",
        0.03,
        unit="1/m",
        minimum=0.0,
        maximum=1.0,
        documentation="How fast the background's colour swallows what is far away.",
    ),
    Parameter(
        "look/style",
        "choice",
        "physical",
        choices=STYLES,
        blend=False,
        documentation="How the player is drawn: as light falls on cloth and metal, or in flat tones.",
    ),
    Parameter(
        "trumpet/finish",
        "choice",
        "lacquer",
        choices=FINISHES,
        blend=False,
        documentation="What the instrument's brass is finished with.",
    ),
    Parameter(
        "blocks/visible",
        "boolean",
        True,
        blend=False,
        documentation="Whether the note blocks and their staff are drawn.",
    ),
    Parameter("blocks/color", "color", "#D9A441", documentation="Colour of the notes to come."),
    Parameter("blocks/sounding_color", "color", "#FFE3A6", documentation="Colour of the note that sounds."),
    Parameter(
        "blocks/opacity",
        "number",
        0.92,
        minimum=0.0,
        maximum=1.0,
        documentation="How solid the note blocks are.",
    ),
    Parameter(
        "blocks/glow",
        "number",
        1.2,
        minimum=0.0,
        maximum=4.0,
        documentation="How strongly the sounding note is lit from within.",
    ),
    Parameter(
        "blocks/speed",
        "number",
        0.9,
        unit="m/s",
        minimum=0.05,
        maximum=10.0,
        documentation="How fast the notes come, and so how long they are.",
    ),
    Parameter(
        "blocks/arrangement",
        "choice",
        "toward_bell",
        choices=ARRANGEMENTS,
        blend=False,
        documentation="Whether the notes come toward the bell or lie as a lane below.",
    ),
)


def stage_registry() -> ParameterRegistry:
    """The registry of the stage's parameters."""
    return ParameterRegistry(STAGE_PARAMETERS)
