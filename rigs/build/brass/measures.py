"""The trumpet's measures in metres.

Its frame: +Z to the bell, +Y up, +X the player's left; the origin lies in the second valve.

Valve 1 is nearest the player's face.
"""

from __future__ import annotations

Y_TOP = 0.0355  # axis height of the leadpipe and the bell's tail
Y_LOW = -0.0480  # of the lower tubes
X_LEADPIPE = -0.0165
X_RETURN = -0.0124  # the lower leg of the tuning slide
X_BELL = 0.0205
TUBE = 0.0063  # outer radius of the tubing
VALVE_Z = (-0.0275, 0.0, 0.0275)
CASING = 0.0108
CASING_BOTTOM = -0.0720
CASING_TOP = 0.058
STROKE = 0.0165
STEM_Y = 0.0662  # where a valve's own frame lies
BUTTON_TOP = 0.0240  # top centre of the button in the valve's frame

Z_RECEIVER = -0.208
Z_MOUTHPIECE = Z_RECEIVER + 0.022  # shank end inside the receiver
Z_RIM = Z_MOUTHPIECE - 0.0878
Z_BELL_BOW = -0.095
Z_BELL_END = 0.272
BELL_RADIUS = 0.0615
FLARE_M = 0.0125
FLARE_POWER = -0.66
TAIL_RADIUS = 0.0061

SLIDE1_X, SLIDE1_Y = 0.006, (-0.026, 0.004)
SLIDE1_Z = VALVE_Z[0] - 0.024  # where the moving slide begins
SLIDE1_REACH = 0.038
SLIDE3_X, SLIDE3_Y = 0.011, (-0.040, -0.015)
SLIDE3_Z = VALVE_Z[2] + 0.040
SLIDE3_REACH = 0.056
SLIDE3_TRAVEL = 0.020
SADDLE = (0.006, SLIDE1_Y[1] + TUBE + 0.012, VALVE_Z[0] - 0.031)
SADDLE_DEPTH = 0.0115
SADDLE_WIRE = 0.0019
RING = (0.0110, SLIDE3_Y[1] + TUBE + 0.0122, VALVE_Z[2] + 0.048)
RING_RADIUS = 0.0112
RING_WIRE = 0.0017
SLIDE2_Y = (-0.025, -0.001)
HOOK_Z = 0.056
HOOK_RADIUS = 0.0024
HOOK_TOP = (X_LEADPIPE - 0.0062, Y_TOP + 0.031, HOOK_Z - 0.017)  # the middle of its wire where it is highest


def bell_radius(distance_from_end: float) -> float:
    """The bell's outer radius at a distance back from its end: a Bessel horn, then the tail's tube."""
    return max(TAIL_RADIUS, BELL_RADIUS * ((distance_from_end + FLARE_M) / FLARE_M) ** FLARE_POWER)
