//! Prints the plan of a job given on standard input.

fn main() {
    let text = std::io::read_to_string(std::io::stdin()).unwrap();
    match touchpath::job::from_json(&text).and_then(|j| touchpath::job::plan(&j)) {
        Ok(p) => {
            println!("{}", p.program.text);
            for r in &p.results {
                println!("{r:?}");
            }
            for f in &p.findings {
                println!("{f:?}");
            }
            println!("{} moves, {} mm, {} min; {} rows", p.moves.len(), p.length, p.time, p.table.len());
        }
        Err(e) => {
            for f in e.findings {
                println!("{f:?}")
            }
        }
    }
}
