"""What players share, whatever they play: phrasing, breath, trunk, legs, face, gaze, idling, stances."""

from reina.instruments.player.body import PlayerBody, Standing
from reina.instruments.player.engagement import Engagement, player_prefix
from reina.instruments.player.glances import plan_glances
from reina.instruments.player.held_pose import HeldPose
from reina.instruments.player.instrument_body import BodyFrames, BodyMotion, InstrumentBody
from reina.instruments.player.phrasing import (
    Phrases,
    in_order,
    movements,
    phrases_of,
    plan_breath,
    plan_phrasing,
)
from reina.instruments.player.seats import SEATS, SEATS_FOR, Seat
from reina.instruments.player.skeleton_layout import SkeletonLayout
from reina.instruments.player.stance_choice import StanceChoice
from reina.instruments.player.stances import STANCES

__all__ = [
    "SEATS",
    "SEATS_FOR",
    "STANCES",
    "BodyFrames",
    "BodyMotion",
    "Engagement",
    "HeldPose",
    "InstrumentBody",
    "Phrases",
    "PlayerBody",
    "Seat",
    "SkeletonLayout",
    "StanceChoice",
    "Standing",
    "in_order",
    "movements",
    "phrases_of",
    "plan_breath",
    "plan_glances",
    "plan_phrasing",
    "player_prefix",
]
