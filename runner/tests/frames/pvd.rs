//! Collections.

use std::io;

use loschmidt_runner::output::pvd::Collection;
use quick_xml::Reader;
use quick_xml::events::Event;

use super::vtp::attribute;

#[test]
fn a_collection_lists_its_files_in_order() {
    let mut collection = Collection::new();
    let files = [(0.0, "frames/a.vtp"), (0.1, "b & <\"c\">.vtp"), (2e22, "d")];
    for (elapsed, file) in files {
        collection.push(elapsed, file).unwrap();
    }
    for (elapsed, file) in [
        (2e22, "again"),
        (1.0, "before"),
        (f64::NAN, "never"),
        (3e22, ""),
        (3e22, "line\nbreak"),
    ] {
        let error = collection.push(elapsed, file).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
    }
    assert_eq!(collection.len(), 3);
    let mut bytes = Vec::new();
    collection.write(&mut bytes).unwrap();
    let mut reader = Reader::from_reader(&bytes[..]);
    let mut found = Vec::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Empty(element) => {
                assert_eq!(element.name().as_ref(), "DataSet");
                let elapsed = attribute(&element, "timestep").unwrap();
                let file = attribute(&element, "file").unwrap();
                found.push((elapsed.parse::<f64>().unwrap(), file));
            }
            Event::Eof => break,
            _ => {}
        }
    }
    assert_eq!(found, files.map(|(elapsed, file)| (elapsed, file.into())));
}
