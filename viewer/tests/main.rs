//! What the pictures promise.

mod home;
mod movie;
mod pixels;
mod window;
