"""What both rigs are built with: meshes, the GLB writer, the source data and the JSON form of a rig."""
