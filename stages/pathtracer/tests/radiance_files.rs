//! What `.hdr` and `.exr` files say beside their pixels.

use exr::image::write::WritableImage;
use exr::image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer};
use exr::meta::attribute::IntegerBounds;
use exr::meta::header::{ImageAttributes, LayerAttributes};
use kit::{Spectrum, Vec3};
use pathtracer::load_environment;
use std::fs;

/// Two texels of radiance 1 before `EXPOSURE` and `COLORCORR`, which radiances are divided by.
#[test]
fn exposure_and_color_correction_of_hdr_files_are_honoured() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.hdr");
    let radiance = |lines: &str| {
        let header = format!("#?RADIANCE\n{lines}FORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n");
        let mut bytes = header.into_bytes();
        bytes.extend([128, 128, 128, 129].repeat(2));
        fs::write(&path, bytes).expect("a file");
        let (environment, note) = load_environment(&path).expect("an environment");
        assert_eq!(note, None);
        environment.radiance(Vec3::X)
    };
    assert_eq!(radiance(""), Spectrum::grey(1.0));
    assert_eq!(radiance("EXPOSURE=2\nEXPOSURE=2\n"), Spectrum::grey(0.25));
    assert_eq!(radiance("COLORCORR=1 2 4\n"), Spectrum::new(1.0, 0.5, 0.25));
}

#[test]
fn the_part_of_an_exr_file_that_is_used_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a.exr");
    let load = |parts: &[(&str, &[&str])]| {
        let layers = parts.iter().map(|(name, channels)| {
            let channel = |name: &&str| AnyChannel::new(*name, FlatSamples::F32(vec![0.5; 2]));
            let channels = AnyChannels::sort(channels.iter().map(channel).collect());
            Layer::new(
                (2, 1),
                LayerAttributes::named(*name),
                Encoding::UNCOMPRESSED,
                channels,
            )
        });
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions((2, 1)));
        let image = Image::from_layers(attributes, layers.collect::<Vec<_>>());
        image.write().to_file(&path).expect("a file");
        load_environment(&path).expect("an environment")
    };
    let colors = &["R", "G", "B"];
    assert_eq!(load(&[("only", colors)]).1, None);
    let (environment, note) = load(&[("depth", &["Z"]), ("beauty", colors), ("more", colors)]);
    assert_eq!(environment.radiance(Vec3::X), Spectrum::grey(0.5));
    let note = note.expect("a note");
    let expected = "the file has 3 parts; using the first one with R, G and B: number 2, `beauty`";
    assert!(note.ends_with(expected), "{note}");
}

/// Its colours are those of a display: no factor makes them radiance.
#[test]
fn a_picture_of_bytes_with_the_name_of_an_environment_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("sky.hdr");
    let file = fs::File::create(&path).expect("a file");
    picture_files::write_png(&file, &[200; 6], [2, 1]).expect("a PNG");
    let why = load_environment(&path)
        .expect_err("no radiance")
        .to_string();
    assert!(
        why.contains("sky.hdr") && why.contains("no radiance"),
        "{why}"
    );
}
