//! From the device's memory into ours.

use super::device::{Device, RenderError};

/// A buffer that can be read here.
pub(super) struct Readback {
    buffer: wgpu::Buffer,
}

impl Readback {
    pub fn new(gpu: &Device, size: u64) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { buffer }
    }

    /// Where to copy to.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Copies all of a buffer.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, from: &wgpu::Buffer) {
        encoder.copy_buffer_to_buffer(from, 0, &self.buffer, 0, self.buffer.size());
    }

    /// Waits for what fills the buffer and hands over what it then holds.
    pub fn read<T>(
        &self,
        gpu: &Device,
        submission: &wgpu::SubmissionIndex,
        take: impl FnOnce(&[u8]) -> T,
    ) -> Result<T, RenderError> {
        // Should it fail, asking for the range below says so.
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.wait(submission)?;
        let taken = {
            let range = self.buffer.get_mapped_range(..).map_err(|error| RenderError::Lost(error.to_string()))?;
            take(&range)
        };
        self.buffer.unmap();
        Ok(taken)
    }
}
