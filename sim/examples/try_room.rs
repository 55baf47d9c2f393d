//! Trial.
use std::path::Path; use std::time::Instant;
fn cpu()->f64{ let s=std::fs::read_to_string("/proc/self/stat").unwrap(); let v:Vec<&str>=s.rsplit(')').next().unwrap().split_whitespace().collect(); v[11].parse::<f64>().unwrap()*10.0 }
fn main(){  let a:Vec<String>=std::env::args().collect();
 let s=sunblind_sim::scenario::Scenario::load(Path::new(&a[1])).unwrap();
 let t=Instant::now(); let room=sunblind_sim::textured_room::TexturedRoom::new(); println!("bake {:?} cpu {} ms",t.elapsed(),cpu());
 if a.len()>3 { let t=Instant::now(); let c=cpu(); for i in (0..10).cycle().take(std::env::var("N").map_or(10,|n|n.parse().unwrap())) { std::hint::black_box(room.frame(&s,i*15)); } println!("frame {:?} cpu {} ms",t.elapsed()/10,(cpu()-c)/10.0); return; }
 let t=Instant::now(); sunblind_sim::textured_room::record(&s,Path::new(&a[2]),|_,_|()).unwrap(); println!("record {:?}",t.elapsed()); }
