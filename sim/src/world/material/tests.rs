//! Every surface in both bands.

use super::*;

#[test]
fn every_surface_is_listed_at_its_own_index_and_painted_plausibly_in_both_bands() {
    let materials = materials(&Surface::ALL, 7);
    for (index, (surface, material)) in Surface::ALL.iter().zip(&materials).enumerate() {
        assert_eq!(surface.index(), index);
        assert_eq!(material.albedo.len(), TEXTURE_SIZE * TEXTURE_SIZE);
        for albedo in mean_albedo(material) {
            assert!((0.005..0.9).contains(&albedo), "{}: {albedo}", material.name);
        }
    }
}

#[test]
fn dyes_vanish_at_830_nm_and_carbon_black_does_not() {
    let mean = |surface: Surface| mean_albedo(&materials(&[surface], 7)[0]);
    let contrast = |[r, g, b, infrared]: [f32; 4]| infrared / (0.21 * r + 0.72 * g + 0.07 * b);
    assert!(contrast(mean(Surface::BlueFabric)) > 3.0);
    assert!(contrast(mean(Surface::Leaf)) > 4.0);
    assert!(contrast(mean(Surface::BlackPlastic)) < 1.4);
    assert!(contrast(mean(Surface::WallPaint)) < 1.2);
}

#[test]
fn the_ground_outdoors_is_as_bright_at_830_nm_as_measured_ground() {
    let contrast = |surface: Surface| {
        let [red, _, _, infrared] = mean_albedo(&materials(&[surface], 7)[0]);
        infrared / red
    };
    assert!(contrast(Surface::Lawn) >= 5.0, "{}", contrast(Surface::Lawn));
    assert!(contrast(Surface::Foliage) >= 5.0 && contrast(Surface::Hedge) >= 5.0);
    // Asphalt 1.2, concrete 1.2, brick 1.1 of measured ones; ± 30 % of it is what is asked for.
    for (surface, measured) in
        [(Surface::Asphalt, 1.2), (Surface::Concrete, 1.2), (Surface::Pavers, 1.2), (Surface::Brick, 1.1)]
    {
        let ratio = contrast(surface) / measured;
        assert!((0.87..1.15).contains(&ratio), "{surface:?}: {}", contrast(surface));
    }
}

#[test]
fn a_seed_gives_its_materials_again_and_another_seed_others() {
    let [a, b, c] = [3, 3, 4].map(|seed| materials(&[Surface::Books], seed).swap_remove(0).albedo);
    assert!(a == b && a != c);
}
