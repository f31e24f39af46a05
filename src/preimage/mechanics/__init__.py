"""The generalised damper with Coulomb friction: normals and angles, no places."""
