"""MusicXML, partwise or timewise, into a score: as it is played, repeats and all."""
