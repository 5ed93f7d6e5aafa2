//! Compares the screen of an X server without a display (`Xvfb -fbdir`) with a PNG of the window,
//! and the PNG with the particles as the rasteriser draws them in a run of its own.
//!
//!     cargo run --example screen -- SCREEN PNG [SCENE STEP [KEY=VALUE]...]
//!
//! The window is in the upper left corner of the screen. Exit code 0: all pixels are equal.

use loschmidt_runner::scene::{load, resolve};
use loschmidt_runner::{Options, Player, Points};
use loschmidt_viewer::window::Places;
use loschmidt_viewer::{Home, Look, Raster, Rect, Rgb, field, picture};
use std::error::Error;
use std::fs::File;
use std::io::BufReader;
use std::process::ExitCode;

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [screen, picture, rest @ ..] = &words[..] else {
        return Err("SCREEN PNG [SCENE STEP [KEY=VALUE]...]".into());
    };
    let picture = picture::read(BufReader::new(File::open(picture)?), Rgb(0))?;
    let screen = screen_of(&std::fs::read(screen)?).ok_or("not a screen")?;
    let mut different = unequal(&screen.part(picture.rect()), &picture);
    println!("screen and PNG: {different} pixels differ");
    if let [scene, step, set @ ..] = rest {
        let scene = load(&resolve(scene)?, set)?;
        let initial = scene.initial_state()?;
        let mut player = Player::new(scene.clone(), initial, Options::default())?;
        let home = Home::new(&scene, &player.frame()?);
        player.advance(step.parse()?)?;
        let (rect, em) = field_of(&home, &picture);
        let mut points = Points::default();
        player.points(&mut points)?;
        let ours = field(&points, &home, &Look::default(), rect.width, rect.height);
        let n = unequal(
            &without_scale(picture.part(rect), em),
            &without_scale(ours.clone(), em),
        );
        println!(
            "PNG and rasteriser at step {step}: {n} of {} pixels differ",
            ours.pixels().len()
        );
        different += n;
    }
    Ok(ExitCode::from(u8::from(different > 0)))
}

/// Where the particles are in a window of this picture's size.
fn field_of(home: &Home, picture: &Raster) -> (Rect, usize) {
    let (width, height) = (picture.width(), picture.height());
    let places = Places::sized(home, &Look::default(), 1, 1.0, (width, height));
    (places.field, places.em)
}

/// The field with its upper left corner blank, where the window has the length scale on top.
fn without_scale(mut field: Raster, em: usize) -> Raster {
    let width = field.width();
    for line in field.pixels_mut().chunks_mut(width).take(4 * em) {
        line.iter_mut().take(12 * em).for_each(|pixel| *pixel = 0);
    }
    field
}

fn unequal(a: &Raster, b: &Raster) -> usize {
    if a.rect() != b.rect() {
        return b.pixels().len();
    }
    a.pixels()
        .iter()
        .zip(b.pixels())
        .filter(|(a, b)| a != b)
        .count()
}

/// A screen dump in the format of `xwd`: big-endian words, then colours of 12 bytes, then rows.
fn screen_of(bytes: &[u8]) -> Option<Raster> {
    let word = |n: usize| {
        let word = bytes.get(4 * n..4 * n + 4)?.try_into().ok()?;
        Some(u32::from_be_bytes(word) as usize)
    };
    let (width, height) = (word(4)?, word(5)?);
    let start = word(0)? + 12 * word(19)?;
    let mut raster = Raster::new(width, height, Rgb(0));
    for (row, line) in raster.pixels_mut().chunks_mut(width).enumerate() {
        let from = start + row * word(12)?;
        for (pixel, bytes) in line
            .iter_mut()
            .zip(bytes.get(from..from + 4 * width)?.chunks(4))
        {
            *pixel = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], 0]);
        }
    }
    Some(raster)
}
