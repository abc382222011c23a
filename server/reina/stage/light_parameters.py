"""The parameters of the lights: key, fill, rim, back wash, the room's own light, and the stage's spots."""

from reina.curves.parameter import Parameter

SPOTS = {
    1: {"position": (-1.9, 4.3, 2.3), "color": "#FFDFB0"},
    2: {"position": (2.1, 4.3, 0.9), "color": "#8FB4FF"},
    3: {"position": (0.3, 4.3, -1.7), "color": "#FFC2A0"},
}
"""Where each spot hangs, metres, and its colour: a warm one and a cool one before the player, one behind."""


def _spot(number: int) -> tuple[Parameter, ...]:
    rest = SPOTS[number]
    path = f"lights/spots/{number}"
    return (
        Parameter(
            f"{path}/intensity",
            "number",
            0.0,
            minimum=0.0,
            maximum=40.0,
            documentation=f"Strength of spot {number} in the middle of its cone; it is off at rest.",
        ),
        Parameter(f"{path}/color", "color", rest["color"], documentation=f"Colour of spot {number}."),
        Parameter(
            f"{path}/position",
            "vector",
            rest["position"],
            unit="m",
            minimum=-50.0,
            maximum=50.0,
            documentation=f"Where spot {number} hangs.",
        ),
        Parameter(
            f"{path}/target",
            "vector",
            (0.0, 1.1, 0.1),
            unit="m",
            minimum=-50.0,
            maximum=50.0,
            documentation=f"The point that spot {number} shines at.",
        ),
        Parameter(
            f"{path}/angle",
            "number",
            0.24,
            unit="rad",
            minimum=0.02,
            maximum=1.2,
            documentation=f"From the middle of spot {number}'s cone to its edge.",
        ),
        Parameter(
            f"{path}/softness",
            "number",
            0.6,
            minimum=0.0,
            maximum=1.0,
            documentation=f"Share of spot {number}'s cone over which it fades out: 0 is a hard edge.",
        ),
    )


LIGHT_PARAMETERS: tuple[Parameter, ...] = (
    Parameter(
        "lights/key/intensity",
        "number",
        3.2,
        minimum=0.0,
        maximum=20.0,
        documentation="Strength of the sun from the window side, which draws the shadows.",
    ),
    Parameter(
        "lights/key/color", "color", "#FFDFBE", documentation="Colour of the sun; at rest about 4,300 K."
    ),
    Parameter(
        "lights/key/position",
        "vector",
        (-3.2, 2.7, 1.6),
        unit="m",
        minimum=-50.0,
        maximum=50.0,
        documentation="Where the sun comes from; it shines on the player.",
    ),
    Parameter(
        "lights/key/softness",
        "number",
        1.0,
        minimum=0.0,
        maximum=4.0,
        documentation="How soft the edges of the sun's shadows are: 0 is hard, 1 a low sun.",
    ),
    Parameter(
        "lights/fill/intensity",
        "number",
        0.55,
        minimum=0.0,
        maximum=20.0,
        documentation="Strength of the room's cool light on the side away from the window.",
    ),
    Parameter("lights/fill/color", "color", "#9FB6DC", documentation="Colour of the room's light."),
    Parameter(
        "lights/rim/intensity",
        "number",
        2.2,
        minimum=0.0,
        maximum=20.0,
        documentation="Strength of the light from behind that draws hair, shoulder and bell.",
    ),
    Parameter("lights/rim/color", "color", "#FFE6C4", documentation="Colour of the light from behind."),
    Parameter(
        "lights/rim/position",
        "vector",
        (1.6, 2.6, -2.2),
        unit="m",
        minimum=-50.0,
        maximum=50.0,
        documentation="Where the light from behind stands.",
    ),
    Parameter(
        "lights/back_wash/intensity",
        "number",
        0.0,
        minimum=0.0,
        maximum=20.0,
        documentation="Strength of the light that washes up the wall behind the player; none at rest.",
    ),
    Parameter(
        "lights/back_wash/color", "color", "#4C6A9A", documentation="Colour of the light on the wall behind."
    ),
    Parameter(
        "lights/ambient/intensity",
        "number",
        0.15,
        minimum=0.0,
        maximum=20.0,
        documentation="Strength of the light that comes from everywhere.",
    ),
    Parameter(
        "lights/ambient/color", "color", "#C9B9A6", documentation="Colour of the light from everywhere."
    ),
    Parameter(
        "lights/environment/intensity",
        "number",
        0.7,
        minimum=0.0,
        maximum=10.0,
        documentation="Strength of the room that metal reflects: bright window, dark floor, warm wall.",
    ),
    *_spot(1),
    *_spot(2),
    *_spot(3),
    Parameter(
        "lights/haze",
        "number",
        0.5,
        minimum=0.0,
        maximum=4.0,
        documentation="How much of the spots' cones shows in the air.",
    ),
)
