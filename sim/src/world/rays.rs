//! Ray casts and distances against a world's triangles.

use glam::{DVec3, Vec3};
use parry3d::query::{PointQuery, Ray};
use parry3d::shape::{CompositeShapeRef, TriMesh};

use super::Object;

/// The triangles of some objects, ordered for fast queries. World frame, metres.
pub struct Rays {
    triangles: TriMesh,
    facing: Vec<DVec3>,
    sources: Vec<Source>,
}

/// Where a triangle comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Source {
    /// Which of the objects given.
    pub object: usize,
    /// Which of its triangles.
    pub triangle: usize,
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    /// Along the ray, in lengths of its direction.
    pub distance: f64,
    /// Index over all triangles, in the objects' order.
    pub triangle: u32,
    /// Whether the triangle faces the ray's origin; if not, the ray left a body it was inside of.
    pub front: bool,
}

impl Rays {
    /// `None` if the objects have no triangle.
    pub fn new<'a>(objects: impl IntoIterator<Item = &'a Object>) -> Option<Self> {
        let (mut vertices, mut indices, mut facing, mut sources) = (vec![], vec![], vec![], vec![]);
        for (object, Object { mesh, .. }) in objects.into_iter().enumerate() {
            let first = vertices.len() as u32;
            vertices.extend(mesh.positions.iter().map(|&position| Vec3::from(position).as_dvec3()));
            for (triangle, &corners) in mesh.triangles.iter().enumerate() {
                indices.push(corners.map(|index| first + index));
                let [a, b, c] = mesh.corners(corners).map(|corner| corner.as_dvec3());
                facing.push((b - a).cross(c - a));
                sources.push(Source { object, triangle });
            }
        }
        // The only way to fail is to have no triangle.
        TriMesh::new(vertices, indices).ok().map(|triangles| Self { triangles, facing, sources })
    }

    /// The first triangle on the way, no further than `reach` (in lengths of `direction`).
    pub fn first(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<Hit> {
        let (triangle, distance) =
            CompositeShapeRef(&self.triangles).cast_local_ray(&Ray::new(origin, direction), reach, true)?;
        Some(Hit { distance, triangle, front: self.facing[triangle as usize].dot(direction) < 0.0 })
    }

    /// Whether something lies between two points.
    pub fn blocked(&self, from: DVec3, to: DVec3) -> bool {
        self.first(from, to - from, 1.0).is_some()
    }

    /// To the nearest triangle, metres.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.triangles.distance_to_local_point(point, false)
    }

    /// Which object's triangle a hit met.
    pub fn source(&self, hit: &Hit) -> Source {
        self.sources[hit.triangle as usize]
    }
}
