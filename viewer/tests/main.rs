//! What the pictures promise.

mod home;
mod movie;
mod pixels;
#[cfg(feature = "window")]
mod window;
