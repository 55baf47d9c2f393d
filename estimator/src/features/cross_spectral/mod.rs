//! Matching across spectra: the same thing in a colour image and in one at 830 nm.
//!
//! Brightness has little in common there (leaves are dark in one and bright in the other), edges have: `edges` (how steep
//! an image is in each direction, everywhere) → `descriptor` (edges about a point, mostly whatever their sign) → matching
//! → `refine` (to a fraction of a pixel). Scale and rotation are taken to be those of one rig's two cameras: near enough
//! the same.

mod band;
mod descriptor;
mod edges;
mod refine;

use serde::{Deserialize, Serialize};

use super::surf::{Surf, SurfParams};
use crate::image::GrayImage;
use band::Search;
use descriptor::Descriptor;
use edges::Edges;
use refine::peak_near;

/// Parameters of matching across spectra.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CrossSpectralParams {
    /// Points sought in each image. Infrared has little contrast, so that far less of a response is asked for than within
    /// one spectrum.
    pub points: SurfParams,
    /// Most that the best match's distance may be of the best elsewhere (Lowe 2004), 0–1.
    pub max_ratio: f32,
    /// From here on it is elsewhere, pixels: neighbours on one thing look alike.
    #[serde(rename = "apart_px")]
    pub apart: f32,
}

impl Default for CrossSpectralParams {
    fn default() -> Self {
        let points = SurfParams { max_features: 1000, min_response: 0.5, octaves: 2, cell: 240 };
        Self { points, max_ratio: 0.8, apart: 6.0 }
    }
}

/// The same thing in both images.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossMatch {
    /// Column and row in the colour image, pixels.
    pub colour: (f32, f32),
    /// Column and row in the infrared image, pixels.
    pub infrared: (f32, f32),
    /// Cosine between the descriptors; 1 is equal.
    pub similarity: f32,
    /// σ of the infrared image's column, pixels: the flatter the similarity's peak and the less alike the two, the larger.
    pub sigma: f32,
}

/// Where in the infrared image a point of the colour image may be: what is known of two cameras side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// Rows up or down, pixels.
    pub rows: f32,
    /// Columns to the right, least and most, pixels.
    pub columns: (f32, f32),
}

/// The matcher with its working memory.
pub struct CrossSpectral {
    params: CrossSpectralParams,
    surf: Surf,
    colour: Edges,
    infrared: Edges,
}

/// A point with its descriptor.
struct Point {
    x: f32,
    y: f32,
    descriptor: Descriptor,
}

impl CrossSpectral {
    /// A matcher; it allocates on first use.
    pub fn new(params: CrossSpectralParams) -> Self {
        let surf = Surf::new(params.points);
        Self { params, surf, colour: Edges::default(), infrared: Edges::default() }
    }

    /// The colour image's points, strongest first, that are found in the infrared image. Within a `band` they are sought
    /// everywhere, without one only among the infrared image's points, of which most show nothing else.
    pub fn match_images(&mut self, colour: &GrayImage, infrared: &GrayImage, band: Option<&Band>) -> Vec<CrossMatch> {
        let Some(band) = band else { return self.match_anywhere(colour, infrared) };
        let points = self.surf.points(colour, |_, _, _| true);
        let places: Vec<_> = points.iter().map(|point| (point.x, point.y)).collect();
        self.match_points(&places, colour, infrared, band).into_iter().flatten().collect()
    }

    /// For each of `places` in the colour image, (column, row) in pixels, where it is found within the band.
    pub fn match_points(
        &mut self,
        places: &[(f32, f32)],
        colour: &GrayImage,
        infrared: &GrayImage,
        band: &Band,
    ) -> Vec<Option<CrossMatch>> {
        self.colour.compute(colour);
        self.infrared.compute(infrared);
        let search = Search { from: &self.colour, to: &self.infrared, band: *band, apart: self.params.apart };
        places.iter().map(|&place| search.find(place, self.params.max_ratio)).collect()
    }

    /// What is each other's best match among the points of either image.
    fn match_anywhere(&mut self, colour: &GrayImage, infrared: &GrayImage) -> Vec<CrossMatch> {
        let from = described(&mut self.surf, &mut self.colour, colour);
        let to = described(&mut self.surf, &mut self.infrared, infrared);
        let mut backward = vec![(f32::NEG_INFINITY, usize::MAX); to.len()];
        let mut forward = Vec::with_capacity(from.len());
        let mut similarities = vec![0.0; to.len()];
        for (i, point) in from.iter().enumerate() {
            let mut best = (f32::NEG_INFINITY, usize::MAX);
            for (j, candidate) in to.iter().enumerate() {
                let similarity = point.descriptor.similarity(&candidate.descriptor);
                similarities[j] = similarity;
                if similarity > best.0 {
                    best = (similarity, j);
                }
                if similarity > backward[j].0 {
                    backward[j] = (similarity, i);
                }
            }
            let Some(found) = to.get(best.1) else { continue };
            let is_elsewhere = |other: &Point| (other.x - found.x).hypot(other.y - found.y) > self.params.apart;
            let rivals = to.iter().zip(&similarities).filter(|(other, _)| is_elsewhere(other));
            let rival = rivals.map(|(_, &similarity)| similarity).fold(f32::NEG_INFINITY, f32::max);
            forward.push((i, best, rival));
        }
        forward.retain(|&(i, (similarity, j), rival)| {
            backward[j].1 == i && is_distinct(similarity, rival, self.params.max_ratio)
        });
        let found = forward.iter().filter_map(|&(i, (_, j), _)| {
            let (point, start) = (&from[i], (to[j].x, to[j].y));
            let peak = peak_near(&point.descriptor, &self.infrared, start)?;
            Some(peak.matched_with((point.x, point.y)))
        });
        found.collect()
    }
}

/// The ratio test (Lowe 2004) on distances between unit vectors.
fn is_distinct(similarity: f32, rival: f32, max_ratio: f32) -> bool {
    1.0 - similarity < max_ratio * max_ratio * (1.0 - rival)
}

fn described(surf: &mut Surf, edges: &mut Edges, image: &GrayImage) -> Vec<Point> {
    edges.compute(image);
    let points = surf.points(image, |_, _, _| true);
    points.iter().map(|p| Point { x: p.x, y: p.y, descriptor: Descriptor::at(edges, p.x, p.y) }).collect()
}

#[cfg(test)]
mod tests;
