//! A collection: the list of a run's frames that ParaView opens as one.
//!
//! The format is that of ParaView's `vtkPVDReader` (*PVD File Format*, ParaView wiki): XML, one
//! `DataSet` per frame with its time and its file, relative to the collection:
//!
//! ```xml
//! <?xml version="1.0"?>
//! <VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
//!   <Collection>
//!     <DataSet timestep="0.0" part="0" file="frames/particles-000000.vtp"/>
//!   </Collection>
//! </VTKFile>
//! ```
//!
//! The time is [`elapsed`](crate::frame::Frame::elapsed), in s and in the fewest digits that keep
//! its bits, so that ParaView plays the way out and then the way back. A reader shows one file per
//! time: the times must rise.

use std::io::{self, Write};

/// The frames of a run, in the order of their times.
#[derive(Clone, Debug, Default)]
pub struct Collection {
    entries: Vec<(f64, String)>,
}

impl Collection {
    /// A collection without frames.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of frames.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is no frame.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Adds the frame at `elapsed` seconds; `file` is relative to the collection, with `/` as the
    /// separator.
    ///
    /// # Errors
    /// `InvalidInput`, and the collection stays as it was, if `elapsed` is not above that of the
    /// last frame or not finite, or if `file` is empty or has control characters.
    pub fn push(&mut self, elapsed: f64, file: impl Into<String>) -> io::Result<()> {
        let file = file.into();
        if !elapsed.is_finite() {
            return Err(refused(format!("a frame at {elapsed} s")));
        }
        if let Some((last, _)) = self.entries.last()
            && elapsed <= *last
        {
            return Err(refused(format!(
                "a frame at {elapsed} s after one at {last} s"
            )));
        }
        if file.is_empty() || file.contains(char::is_control) {
            return Err(refused(format!("a frame in the file {file:?}")));
        }
        self.entries.push((elapsed, file));
        Ok(())
    }

    /// Writes one whole file.
    ///
    /// # Errors
    /// What `to` reports.
    pub fn write(&self, mut to: impl Write) -> io::Result<()> {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  \
             <Collection>\n",
        );
        for (elapsed, file) in &self.entries {
            text.push_str("    <DataSet timestep=\"");
            text.push_str(zmij::Buffer::new().format(*elapsed));
            text.push_str("\" part=\"0\" file=\"");
            for character in file.chars() {
                match character {
                    '&' => text.push_str("&amp;"),
                    '<' => text.push_str("&lt;"),
                    '>' => text.push_str("&gt;"),
                    '"' => text.push_str("&quot;"),
                    other => text.push(other),
                }
            }
            text.push_str("\"/>\n");
        }
        text.push_str("  </Collection>\n</VTKFile>\n");
        to.write_all(text.as_bytes())
    }
}

fn refused(what: String) -> io::Error {
    io::Error::new(
        io::ErrorKind::InvalidInput,
        format!("{what} cannot stand in a collection"),
    )
}
