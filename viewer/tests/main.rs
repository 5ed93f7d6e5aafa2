//! What the pictures promise.

mod home;
mod pixels;
