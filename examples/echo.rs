//! Loschmidt's echo: how one flipped bit ruins a return.
//!
//! A small dam break is run out, turned, and run back: it comes home to the last bit. Then the same
//! again, but at the turnaround the last bit of one coordinate of one particle, 1.4e-14 m, is
//! flipped. The later the turn, the farther from home the particles end.
//!
//! ```text
//! cargo run --release -p loschmidt-examples --example echo
//! ```

use loschmidt_runner::scene::{Source, load};
use loschmidt_runner::{Options, Player};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let source = Source::Catalogue("dam-break".to_owned());
    let scene = load(&source, &["particle_spacing=0.05".to_owned()])?;
    let initial = scene.initial_state()?;
    println!(" turned at   untouched    one bit flipped");
    println!("    s        returns      largest error, m   particles astray");
    for steps in [400, 800, 1200, 1600, 2000, 2400] {
        let mut returns = Vec::new();
        for perturbed in [false, true] {
            let mut player = Player::new(scene.clone(), initial.clone(), Options::default())?;
            player.advance(steps)?;
            if perturbed {
                player.flip_last_bit(0);
            }
            player.turn();
            player.advance(steps)?;
            returns.push(player.compare_with_home());
        }
        println!(
            "   {:.2}       {}      {:.3e}          {} of {}",
            steps as f64 * scene.time_step(),
            if returns[0].is_exact() {
                "exactly "
            } else {
                "NOT exactly"
            },
            returns[1].error,
            returns[1].astray,
            initial.fluid.len()
        );
    }
    Ok(())
}
