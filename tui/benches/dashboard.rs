//! What the dashboard costs: the steps that a scene takes headless and under the dashboard, side by
//! side, on a real terminal of 200 x 60 cells, all colours, as fast as it goes.
//!
//!     cargo bench -p loschmidt-tui --bench dashboard [SPACING] [SECONDS]
//!
//! Both start at home; each is stopped after the same time, and its manifest tells how many steps
//! there were. Headless writes no frames, and the dashboard draws 30 a second.

#[cfg(not(unix))]
fn main() {}

#[cfg(unix)]
fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let spacing = arguments.first().map_or("0.02", String::as_str);
    let seconds = arguments
        .get(1)
        .and_then(|s| s.parse().ok())
        .unwrap_or(10.0);
    unix::compare(spacing, std::time::Duration::from_secs_f64(seconds));
}

#[cfg(unix)]
mod unix {
    use portable_pty::{CommandBuilder, PtySize, native_pty_system};
    use std::io::{Read, Write};
    use std::path::Path;
    use std::process::{Command, Stdio};
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::{Duration, Instant};

    const PROGRAM: &str = env!("CARGO_BIN_EXE_loschmidt");

    /// Rounds of one after the other, so that a busy machine is fair to both.
    const ROUNDS: usize = 3;

    pub fn compare(spacing: &str, time: Duration) {
        let spacing = format!("particle_spacing={spacing}");
        println!(
            "dam-break, {spacing}, {ROUNDS} rounds of {:.0} s",
            time.as_secs_f64()
        );
        println!(
            "{:>12} {:>12} {:>8} {:>10}",
            "headless", "dashboard", "ratio", "frames/s"
        );
        let mut ratios = Vec::new();
        for _ in 0..ROUNDS {
            let headless = headless(&spacing, time);
            let (watched, frames) = watched(&spacing, time);
            let ratio = watched / headless;
            println!(
                "{headless:>8.1} st/s {watched:>8.1} st/s {:>6.1} % {frames:>10.1}",
                100.0 * ratio
            );
            ratios.push(ratio);
        }
        ratios.sort_by(f64::total_cmp);
        println!(
            "median {:.1} % of the headless throughput",
            100.0 * ratios[ROUNDS / 2]
        );
    }

    /// Steps of a run, from its manifest.
    fn steps(run: &Path) -> f64 {
        let text = std::fs::read_to_string(run.join("manifest.json")).expect("a manifest");
        let manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        manifest["steps"].as_u64().expect("steps") as f64
    }

    fn headless(spacing: &str, time: Duration) -> f64 {
        let place = tempfile::tempdir().expect("a directory");
        let mut child = Command::new(PROGRAM)
            .args([
                "run",
                "dam-break",
                "--quiet",
                "--out",
                "run",
                "--set",
                spacing,
            ])
            .args(["--set", "output.frames=0"])
            .current_dir(&place)
            .stderr(Stdio::null())
            .spawn()
            .expect("the program");
        let series = place.path().join("run/series.csv");
        while !series.exists() {
            std::thread::sleep(Duration::from_millis(1));
        }
        let began = Instant::now();
        std::thread::sleep(time);
        signal(child.id());
        let taken = began.elapsed();
        child.wait().expect("an end");
        steps(&place.path().join("run")) / taken.as_secs_f64()
    }

    /// Steps and frames per second.
    fn watched(spacing: &str, time: Duration) -> (f64, f64) {
        let place = tempfile::tempdir().expect("a directory");
        let size = PtySize {
            rows: 60,
            cols: 200,
            pixel_width: 0,
            pixel_height: 0,
        };
        let pair = native_pty_system().openpty(size).expect("a terminal");
        let mut command = CommandBuilder::new(PROGRAM);
        command.args(["tui", "dam-break", "--set", spacing]);
        command.cwd(place.path());
        command.env("TERM", "xterm-256color");
        command.env("COLORTERM", "truecolor");
        command.env_remove("NO_COLOR");
        let mut child = pair.slave.spawn_command(command).expect("the program");
        drop(pair.slave);
        let mut output = pair.master.try_clone_reader().expect("its output");
        let mut keys = pair.master.take_writer().expect("its input");
        // A frame begins with this; nothing else of what is drawn is looked at.
        const FRAME: &[u8] = b"\x1b[?2026h";
        let frames = Arc::new(AtomicU64::new(0));
        let counted = Arc::clone(&frames);
        std::thread::spawn(move || {
            let mut bytes = vec![0; 1 << 18];
            while let Ok(n @ 1..) = output.read(&mut bytes) {
                let found = bytes[..n]
                    .windows(FRAME.len())
                    .filter(|w| *w == FRAME)
                    .count();
                counted.fetch_add(found as u64, Ordering::Relaxed);
            }
        });
        // The scene is there when some frames are; a key before that means nothing.
        while frames.load(Ordering::Relaxed) < 10 {
            std::thread::sleep(Duration::from_millis(1));
        }
        for _ in 0..20 {
            keys.write_all(b"]").expect("a key");
            std::thread::sleep(Duration::from_millis(20));
        }
        // From here on it is as fast as it goes; steps are counted between two states that are
        // kept.
        let run = place.path().join("runs/dam-break-1");
        keys.write_all(b"s").expect("a key");
        while !run.join("manifest.json").exists() {
            std::thread::sleep(Duration::from_millis(1));
        }
        let before = steps(&run);
        let (began, first) = (Instant::now(), frames.load(Ordering::Relaxed));
        std::thread::sleep(time);
        let drawn = frames.load(Ordering::Relaxed) - first;
        keys.write_all(b"q").expect("a key");
        let taken = began.elapsed();
        child.wait().expect("an end");
        let run = place.path().join("runs/dam-break-2");
        let steps = steps(&run) - before;
        (
            steps / taken.as_secs_f64(),
            drawn as f64 / taken.as_secs_f64(),
        )
    }

    fn signal(id: u32) {
        let sent = Command::new("kill")
            .args(["-INT", &id.to_string()])
            .status();
        assert!(sent.expect("kill").success());
    }
}
