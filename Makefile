# The commands of README.md. One optimised build serves them all.

OUT := out
SUNBLIND := target/release/sunblind
# The canary must fail, and nobody drives through the textured room.
DRIVEN := $(filter-out %/canary.toml %/textured_room.toml,$(wildcard scenarios/*.toml scenarios/modes/*.toml))

.PHONY: help build demo test lint scenarios bench gallery clean

help: ## what there is
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## /\1\t/' | expand -t 10

build: ## the sunblind command
	@.ci/setup
	cargo build --release --workspace

demo: build ## a robot drives through a laboratory on its own estimate; ends with a report
	$(SUNBLIND) run scenarios/lab_loop.toml --out $(OUT)/demo
	@.ci/show $(OUT)/demo/report.html

test: build ## formatting and every test
	cargo fmt --check
	cargo test --release --workspace

lint: ## clippy, warnings are errors
	cargo clippy --release --workspace --all-targets -- -D warnings

scenarios: build ## every scenario in its full form, judged; the tests only run short forms
	$(SUNBLIND) run $(DRIVEN) --out $(OUT)/scenarios

bench: build ## times a frame, simulated and estimated in each mode, and SURF beside dlib's where that is built (needs recorded data)
	cargo bench -p sunblind-sim --bench render
	cargo bench -p sunblind-tests

gallery: build ## pictures of ten places in five lights, for docs/gallery.md
	@docs/make-gallery

clean: ## forgets builds and outputs
	cargo clean
	rm -rf $(OUT)
