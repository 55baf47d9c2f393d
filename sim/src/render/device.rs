//! The graphics adapter: whatever Vulkan driver there is, else OpenGL ES. Without a graphics card that is Mesa's
//! lavapipe, which computes on the processor.

use thiserror::Error;

/// Why nothing can be rendered.
#[derive(Debug, Error)]
pub enum RenderError {
    /// No driver.
    #[error(
        "no graphics adapter found, neither Vulkan nor OpenGL ES; a graphics card is not needed, a driver is: \
         install the package mesa-vulkan-drivers (Debian, Ubuntu, Fedora; with libvulkan1 or vulkan-loader)"
    )]
    NoAdapter,
    /// The driver refuses to work.
    #[error("the graphics adapter {adapter} gives no device: {reason}")]
    Device {
        /// Which one.
        adapter: String,
        /// In the driver's words.
        reason: String,
    },
    /// The driver stopped working.
    #[error("the graphics adapter stopped answering: {0}")]
    Lost(String),
    /// A texture that is none.
    #[error("material \"{name}\" has {texels} texels; a texture has 512 × 512")]
    Material {
        /// Its name.
        name: String,
        /// What it has.
        texels: usize,
    },
    /// More textures than the adapter holds.
    #[error("the world has {materials} materials; this graphics adapter holds {limit}")]
    TooManyMaterials {
        /// Those of the world, and one that is always there.
        materials: usize,
        /// The adapter's limit.
        limit: u32,
    },
}

/// An adapter, opened.
pub(super) struct Device {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub adapter: Adapter,
}

/// Which driver made the images; results are only comparable with its version at hand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adapter {
    /// As the driver names it: "llvmpipe (LLVM 15.0.6, 256 bits)".
    pub name: String,
    /// The driver and its version: "llvmpipe, Mesa 22.3.6 (LLVM 15.0.6)".
    pub driver: String,
    /// The interface it is spoken to through.
    pub backend: String,
}

impl Adapter {
    /// The adapter that everything is rendered with.
    ///
    /// # Errors
    /// There is none, or it does not work.
    pub fn find() -> Result<Self, RenderError> {
        Device::open().map(|device| device.adapter)
    }
}

impl Device {
    pub fn open() -> Result<Self, RenderError> {
        let adapter = [wgpu::Backends::VULKAN, wgpu::Backends::GL].into_iter().find_map(first_adapter);
        let adapter = adapter.ok_or(RenderError::NoAdapter)?;
        let info = adapter.get_info();
        let descriptor = wgpu::DeviceDescriptor { required_limits: adapter.limits(), ..Default::default() };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| RenderError::Device { adapter: info.name.clone(), reason: error.to_string() })?;
        let adapter = Adapter {
            name: info.name,
            driver: format!("{}, {}", info.driver, info.driver_info),
            backend: info.backend.to_string(),
        };
        Ok(Self { device, queue, adapter })
    }

    /// Waits until that is done.
    pub fn wait(&self, submission: &wgpu::SubmissionIndex) -> Result<(), RenderError> {
        self.device
            .poll(wgpu::PollType::Wait { submission_index: Some(submission.clone()), timeout: None })
            .map(|_| ())
            .map_err(|error| RenderError::Lost(error.to_string()))
    }
}

fn first_adapter(backends: wgpu::Backends) -> Option<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = backends;
    let instance = wgpu::Instance::new(descriptor);
    pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_driver_is_told_by_the_package_that_brings_it() {
        assert!(RenderError::NoAdapter.to_string().contains("mesa-vulkan-drivers"));
    }
}
