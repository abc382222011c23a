"""This stage: its parameters, its cinematography, and the first show that is written from a music's form."""

from reina.stage.cast_form import CastForm, Place
from reina.stage.default_show import write_default_show
from reina.stage.light_moods import LIGHT_MOODS, MOOD_REST, LightMood
from reina.stage.music_form import MusicForm
from reina.stage.stage_parameters import STAGE_PARAMETERS, stage_registry

__all__ = [
    "LIGHT_MOODS",
    "MOOD_REST",
    "STAGE_PARAMETERS",
    "CastForm",
    "LightMood",
    "MusicForm",
    "Place",
    "stage_registry",
    "write_default_show",
]
