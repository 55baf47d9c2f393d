//! The file, and what it refers to: buffers and images beside it or inside it.

use std::fs;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use gltf::{Document, Gltf, buffer, image as gltf_image};
use image::RgbaImage;

/// A glTF document with its buffers.
pub(super) struct Source {
    pub document: Document,
    buffers: Vec<Vec<u8>>,
    folder: PathBuf,
}

impl Source {
    pub fn read(file: &Path) -> Result<Self, String> {
        let bytes = fs::read(file).map_err(|error| format!("can't be read: {error}"))?;
        let Gltf { document, blob } = Gltf::from_slice(&bytes)
            .map_err(|error| format!("is no glTF 2.0 file: {error}; export it as .glb or .gltf"))?;
        let folder = file.parent().map_or_else(PathBuf::new, Path::to_owned);
        let mut blob = blob;
        let buffers = document
            .buffers()
            .map(|buffer| {
                let bytes = match buffer.source() {
                    buffer::Source::Bin => blob.take().ok_or_else(|| "its binary part is missing".to_owned()),
                    buffer::Source::Uri(uri) => fetch(&folder, uri),
                }
                .map_err(|problem| format!("buffer {}: {problem}", buffer.index()))?;
                match bytes.len() < buffer.length() {
                    true => Err(format!(
                        "buffer {}: {} bytes of {}; the file is cut short",
                        buffer.index(),
                        bytes.len(),
                        buffer.length()
                    )),
                    false => Ok(bytes),
                }
            })
            .collect::<Result<_, _>>()?;
        let source = Self { document, buffers, folder };
        source.check_views()?;
        Ok(source)
    }

    /// The reader panics at data that lie outside their buffer.
    fn check_views(&self) -> Result<(), String> {
        for view in self.document.views() {
            let room = self.buffers[view.buffer().index()].len();
            if view.offset().checked_add(view.length()).is_none_or(|end| end > room) {
                return Err(format!("buffer view {} reaches beyond its buffer of {room} bytes", view.index()));
            }
        }
        for accessor in self.document.accessors() {
            let Some(view) = accessor.view() else { continue };
            let stride = view.stride().unwrap_or(accessor.size());
            let last = accessor.count().saturating_sub(1);
            let end = stride.checked_mul(last).and_then(|end| end.checked_add(accessor.offset() + accessor.size()));
            if end.is_none_or(|end| end > view.length()) {
                return Err(format!("accessor {} reaches beyond its buffer view", accessor.index()));
            }
        }
        Ok(())
    }

    pub fn buffer(&self, buffer: &gltf::Buffer<'_>) -> Option<&[u8]> {
        self.buffers.get(buffer.index()).map(Vec::as_slice)
    }

    /// Decodes an image: PNG or JPEG.
    pub fn image(&self, image: &gltf_image::Image<'_>) -> Result<RgbaImage, String> {
        let decoded = match image.source() {
            gltf_image::Source::View { view, .. } => {
                let bytes = &self.buffers[view.buffer().index()][view.offset()..view.offset() + view.length()];
                image::load_from_memory(bytes).map_err(|error| error.to_string())
            }
            gltf_image::Source::Uri { uri, .. } => {
                let bytes = fetch(&self.folder, uri)?;
                image::load_from_memory(&bytes).map_err(|error| format!("{uri}: {error}"))
            }
        };
        let what = format!("image {}", image.index());
        decoded.map(|image| image.to_rgba8()).map_err(|problem| format!("{what}: {problem}; PNG and JPEG can be read"))
    }
}

/// What a URI names: data in itself, or a file beside the document.
fn fetch(folder: &Path, uri: &str) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let encoded = data.split_once(";base64,").ok_or("a data URI that is not in base64")?.1;
        return BASE64_STANDARD.decode(encoded).map_err(|error| format!("its data URI: {error}"));
    }
    let path = folder.join(uri.replace("%20", " "));
    fs::read(&path).map_err(|error| format!("{}: {error}; keep it beside the glTF file", path.display()))
}
