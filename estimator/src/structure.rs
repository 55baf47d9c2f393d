//! 3D points from images.
