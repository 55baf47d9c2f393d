//! Trial.
use std::path::Path; use std::time::Instant;
fn main(){ let a:Vec<String>=std::env::args().collect();
 let s=sunblind_sim::scenario::Scenario::load(Path::new(&a[1])).unwrap();
 let t=Instant::now(); let room=sunblind_sim::textured_room::TexturedRoom::new(); println!("bake {:?}",t.elapsed());
 if a.len()>3 { let t=Instant::now(); for i in 0..10 { std::hint::black_box(room.frame(&s,i*15)); } println!("frame {:?}",t.elapsed()/10); return; }
 let t=Instant::now(); sunblind_sim::textured_room::record(&s,Path::new(&a[2]),|_,_|()).unwrap(); println!("record {:?}",t.elapsed()); }
