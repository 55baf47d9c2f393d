//! Depth in daylight. Nobody has published how much of it a Kinect v1 has by illuminance: the targets are a model's,
//! photons of the dots against the noise of the sun's, uncertain by a factor of two in light and 1.6 in range. One-sided
//! ones rest on reports of users ("useless above some 10 klx").

use super::bench::{Bench, Wall};
use super::scene::Light;
use super::statistics::falls_below;
use super::{Effort, Finding, Findings};
use crate::render::RenderError;

/// Of walls outdoors at 830 nm: concrete, brick and stone have 0.34 to 0.45.
const FACADE: f32 = 0.4;

/// Shares with depth, and with full scale in the infrared image, of façades at distances in lights.
fn facades(views: &[(f32, Light)]) -> Result<Vec<[f64; 2]>, RenderError> {
    let walls: Vec<_> =
        views.iter().map(|&(distance, light)| Wall { light, albedo: FACADE, ..Wall::at(distance) }).collect();
    let seen = Bench::look_at_all(&walls)?;
    let shares = views.iter().zip(&seen);
    Ok(shares.map(|((distance, _), seen)| [seen.about(f64::from(*distance)).valid, seen.saturated()]).collect())
}

/// V10: more than 80 % valid to some 3 m.
pub(super) fn soft_light(effort: Effort) -> Findings {
    let distances: &[f32] = match effort {
        Effort::Full => &[1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5],
        Effort::Reduced => &[2.0, 3.0, 4.0, 5.5],
    };
    let all = [
        ("5 klx of overcast sky", Light::overcast(5.0)),
        ("10 klx of clear sky in the shade", Light::shade(10.0)),
        ("10 klx of overcast sky", Light::overcast(10.0)),
    ];
    let mut findings = vec![];
    for &(name, light) in effort.of(&all, 1) {
        let views: Vec<_> = distances.iter().map(|&distance| (distance, light)).collect();
        let valid: Vec<_> =
            distances.iter().zip(facades(&views)?).map(|(&z, [valid, _])| [f64::from(z), valid]).collect();
        let what = format!("range with 80 % valid, {name}, m");
        findings.push(Finding::new(what, 3.0, 2.0..=5.0, falls_below(0.8, &valid)));
    }
    Ok(findings)
}

/// V11: none at 3 m, below 20 % from 1.5 m on, and an infrared image that can still be used.
pub(super) fn full_sun(_: Effort) -> Findings {
    let (full, half) = (Light::sun(100.0), Light::sun(50.0));
    let shares = facades(&[(1.5, full), (3.0, full), (2.5, half)])?;
    Ok(vec![
        Finding::new("valid at 1.5 m, 100 klx, share", 0.0, 0.0..=0.2, shares[0][0]),
        Finding::new("valid at 3 m, 100 klx, share", 0.0, 0.0..=0.01, shares[1][0]),
        Finding::new("valid at 2.5 m, 50 klx, share", 0.0, 0.0..=0.2, shares[2][0]),
        Finding::new("infrared at full scale, façade in 100 klx, share", 0.0, 0.0..=0.02, shares[1][1]),
    ])
}

/// V12: from 90 % to 20 % within a factor in light of 3.6 where exposure holds half scale, of 13 where it is fixed.
pub(super) fn drop_out(effort: Effort) -> Findings {
    let kilolux: &[f32] = match effort {
        Effort::Full => &[0.0, 0.5, 1.0, 2.0, 2.8, 4.0, 5.6, 8.0, 11.0, 16.0, 22.0, 32.0, 50.0, 100.0],
        Effort::Reduced => &[0.0, 2.0, 4.0, 8.0, 16.0, 32.0, 100.0],
    };
    let views: Vec<_> = kilolux.iter().map(|&kilolux| (3.0, Light::sun(kilolux))).collect();
    let valid: Vec<f64> = facades(&views)?.iter().map(|[valid, _]| *valid).collect();
    let rise = valid.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    // Over the logarithm of light; darkness has none.
    let curve: Vec<_> = kilolux.iter().zip(&valid).skip(1).map(|(&sun, &valid)| [f64::from(sun).ln(), valid]).collect();
    let factor = (falls_below(0.2, &curve) - falls_below(0.9, &curve)).exp();
    Ok(vec![
        Finding::new("factor in sun from 90 % to 20 % valid at 3 m", 3.6, 2.0..=13.0, factor),
        Finding::new("valid at 3 m without sun, share", 1.0, 0.98..=1.0, valid[0]),
        Finding::new("valid at 3 m, 100 klx, share", 0.0, 0.0..=0.01, valid[valid.len() - 1]),
        Finding::new("largest rise of the valid share as the sun grows", 0.0, 0.0..=0.01, rise),
    ])
}

/// V13: the low sun has far more infrared than its lux says.
pub(super) fn low_sun(effort: Effort) -> Findings {
    let all = [(5.0, 3.0), (3.0, 3.0), (3.0, 4.0)];
    let views = effort.of(&all, 2);
    let seen = facades(&views.iter().map(|&(elevation, z)| (z, Light::low_sun(elevation))).collect::<Vec<_>>())?;
    let finding = |(&(elevation, z), [valid, _]): (&(f32, f32), [f64; 2])| {
        let kilolux = Light::low_sun(elevation).lux / 1000.0;
        let what = format!("valid at {z} m, facing a sun {elevation}° high ({kilolux:.0} klx), share");
        Finding::new(what, 0.0, 0.0..=0.2, valid)
    };
    Ok(views.iter().zip(seen).map(finding).collect())
}
