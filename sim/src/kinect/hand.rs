//! A hand on the device's front: nothing of the world gets in, and what the cameras see of the palm, a few centimetres
//! before lenses that are sharp from half a metre on, is one even patch.

use crate::render::{ColourSensor, InfraredSensor};

/// Radiance of the palm before the infrared camera, W m⁻² sr⁻¹. The projector lights it 75 mm beside what the camera sees,
/// and what gets there has gone to and fro between skin and housing: of 60 mW some 0.7 mW m⁻² sr⁻¹, with 0.6 for the skin's
/// albedo at 830 nm, 0.05 for the housing's and 3 cm between them. Estimate, to a factor of 5.
const PALM_RADIANCE: f32 = 7e-4;

/// What becomes of the light on the chips. Of visible light there is none.
pub(super) fn cover(colour: &mut ColourSensor, infrared: &mut InfraredSensor) {
    colour.electrons_per_luminance = 0.0;
    infrared.stray_electrons = PALM_RADIANCE * infrared.electrons_per_radiance;
    infrared.electrons_per_radiance = 0.0;
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::kinect::calibration::Calibration;
    use crate::kinect::matcher::NO_DEPTH;
    use crate::kinect::{Imaging, Kinect};
    use crate::render::Sweep;
    use crate::validation::scene::looking;
    use crate::world::laboratory::laboratory;

    #[test]
    fn under_a_hand_there_is_one_even_patch_and_no_depth() {
        let mut world = laboratory(1);
        for object in &mut world.objects {
            object.mesh.irradiance = vec![[300.0, 300.0, 300.0, 0.0]; object.mesh.positions.len()];
        }
        let mut kinect = Kinect::new(&world, Calibration::nominal(), Imaging::default(), 1).expect("an adapter");
        let sweep = Sweep::still(looking(DVec3::new(4.0, 1.2, 0.6), DVec3::X));
        let with_depth = |raw: &[u16]| raw.iter().filter(|&&raw| raw != NO_DEPTH).count() as f64 / raw.len() as f64;
        let open = kinect.capture(&sweep, 0).expect("a frame");
        assert!(with_depth(open.depth_raw.pixels()) > 0.5);
        kinect.cover(true);
        // Until the exposures have found out that it is dark.
        for frame in 1..12 {
            let covered = kinect.capture(&sweep, frame).expect("a frame");
            assert!(with_depth(covered.depth_raw.pixels()) < 1e-3, "depth of a palm, frame {frame}");
            assert!(covered.rgb.pixels().iter().flatten().all(|&level| level < 70), "light, frame {frame}");
            let numbers = covered.infrared.pixels().iter().map(|&number| f64::from(number));
            let mean = numbers.clone().sum::<f64>() / numbers.len() as f64;
            let spread = (numbers.map(|number| (number - mean).powi(2)).sum::<f64>() / (640.0 * 480.0)).sqrt();
            assert!(spread < 0.1 * mean + 4.0, "a pattern, frame {frame}: {mean} ± {spread}");
        }
        kinect.cover(false);
        assert!(kinect.capture(&sweep, 12).expect("a frame").rgb.pixels().iter().any(|pixel| pixel[1] > 100));
    }
}
