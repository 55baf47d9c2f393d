//! What the images of a run held on average.

use rayon::prelude::*;
use sunblind_estimator::mode::{Energies, of_colour, of_depth, of_infrared};
use sunblind_estimator::{Measurement, MeasurementData, Rig};

/// Sums over colour, infrared and depth images, and how many there were.
#[derive(Default)]
pub(super) struct MeanEnergies([(f64, u32); 3]);

impl MeanEnergies {
    pub fn take(&mut self, measurements: &[Measurement], rig: &Rig) {
        let energy = |measurement: &Measurement| match &measurement.data {
            MeasurementData::Rgb(image) => Some((0, of_colour(image))),
            MeasurementData::Infrared(image) => Some((1, of_infrared(image))),
            MeasurementData::Depth(image) => Some((2, of_depth(image, &rig.depth))),
            _ => None,
        };
        // Summed in order: sums of floating point depend on it.
        let energies: Vec<_> = measurements.par_iter().filter_map(energy).collect();
        for (kind, energy) in energies {
            self.0[kind].0 += energy;
            self.0[kind].1 += 1;
        }
    }

    pub fn means(&self) -> Energies {
        let [rgb, infrared, depth] = self.0.map(|(sum, count)| (count > 0).then(|| sum / f64::from(count)));
        Energies { rgb, infrared, depth }
    }
}
