# The README's commands. Beneath lie CMake presets: whoever knows CMake never needs make.
#
#   make run     set up, build, and play a recorded emergency
#   make test    set up, then everything that CI checks
#   make build   leaves build/release/saca
#   make model   the local language model: libraries, weights, the choice for this processor
#   make bench   every figure of docs/results.md
#   make soak    long runs: kills, deadlines, first contacts, futures, evasions
.PHONY: run test build model bench setup soak

SCENARIO ?= 100car_9018

run: build model
	build/release/saca run $(SCENARIO)

setup:
	@tools/setup.sh

# The model's libraries come first: the program that runs the model is built with them.
build: setup
	@tools/model/setup.sh llama
	@cmake --preset release > /dev/null
	@cmake --build --preset release

model: setup
	@tools/model/setup.sh all

test: setup
	@tools/model/setup.sh server
	@tools/check.sh

bench: build model
	@tools/bench.sh

# Long runs: kills in the middle of memory's writes; deadlines and deaths of the language model;
# first contacts against brute force; the batch against the scalar model; evasions against the values that they follow; air3D on fine grids.
soak: setup model
	@cmake --preset dev > /dev/null && cmake --build --preset dev --target memory_store_test outcome_exactness_test eval_rollout_agreement_test reach_follow_agreement_test reach_air3d_reference_test model_host_soak_test -- --quiet
	SACA_SOAK_KILLS=$${SACA_SOAK_KILLS:-500} build/dev/modules/memory/memory_store_test --gtest_filter='*Killed*'
	SACA_SOAK_ASKS=$${SACA_SOAK_ASKS:-1000} SACA_SOAK_CHILD_KILLS=$${SACA_SOAK_CHILD_KILLS:-200} build/dev/apps/model_host/model_host_soak_test
	SACA_SOAK_PAIRS=$${SACA_SOAK_PAIRS:-100000} build/dev/modules/outcome/outcome_exactness_test
	SACA_AGREEMENT_ENCOUNTERS=$${SACA_AGREEMENT_ENCOUNTERS:-4000} build/dev/modules/eval/eval_rollout_agreement_test
	SACA_SOAK_REACH=1 build/dev/modules/reach/reach_follow_agreement_test
	SACA_SOAK_AIR3D=1 build/dev/modules/reach/reach_air3d_reference_test
