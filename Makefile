# The README's commands. Beneath lie CMake presets: whoever knows CMake never needs make.
#
#   make run     set up, build, and play a recorded emergency
#   make test    set up, then everything that CI checks
#   make build   leaves build/release/saca
#   make model   the local language model: libraries, weights, the choice for this processor
#   make lint    clang-tidy over everything; `make test` looks at what has changed
#   make bench   measures every figure of docs/results.md anew and makes the page; about a quarter of an hour
#   make aarch64 what drives, and its tests, built for 64-bit Arm and run under qemu; half an hour
#   make soak    long runs: kills, deadlines, first contacts, futures, evasions
.PHONY: run test build model bench lint setup soak aarch64

SCENARIO ?= 100car_8456

run: build model
	@mkdir -p runs
	build/release/saca run $(SCENARIO) --memory runs/memory.sqlite

setup:
	@tools/setup.sh

# The model's libraries come first: the program that runs the model is built with them.
build: setup
	@tools/model/setup.sh llama
	@cmake --preset release > /dev/null
	@cmake --build --preset release --target programs

model: setup
	@tools/model/setup.sh all

test: setup model
	@tools/check.sh

lint: setup
	@tools/lint/run.sh

aarch64: build
	@tools/aarch64.sh all

measuring := rollout_bench sim_bench intent_bench memory_bench model_host_process_bench
# Only the programs that measure are built, not the tests.
bench: build model
	@cmake --build --preset release --target $(measuring) -- --quiet
	@tools/bench.sh

# Long runs, on a machine of its own: kills in the middle of memory's writes; deadlines and deaths of the
# language model beside one busy core; deadlines of a connection in real time; a server that others
# wrote; first contacts against brute force; the batch against the scalar model; evasions against the
# values that they follow; air3D on fine grids; memory over a day's drive. `make test` has a short form of each, without the clock.
release := build/release
soak: setup
	@tools/model/setup.sh server
	@cmake --preset release > /dev/null && cmake --build --preset release -- --quiet
	SACA_SOAK_KILLS=$${SACA_SOAK_KILLS:-1000} $(release)/modules/memory/memory_test --gtest_filter='*Killed*'
	SACA_SOAK_ASKS=$${SACA_SOAK_ASKS:-1000} SACA_SOAK_CHILD_KILLS=$${SACA_SOAK_CHILD_KILLS:-200} $(release)/apps/model_host/model_host_test --gtest_filter='SoakTest.*:HostTest.NoPrompt*'
	SACA_SOAK_CLOCK=1 $(release)/modules/language_model/language_model_test --gtest_filter='*RealTime*'
	PYTHONDONTWRITEBYTECODE=1 python3 -m pytest -q -p no:cacheprovider tests/cli/real_server_test.py
	SACA_SOAK_TABLES=1 PYTHONDONTWRITEBYTECODE=1 python3 -m pytest -q -p no:cacheprovider tests/cli/suite_test.py -k table
	SACA_SOAK_PAIRS=$${SACA_SOAK_PAIRS:-100000} $(release)/modules/collision/collision_test --gtest_filter='Exactness.*'
	SACA_AGREEMENT_ENCOUNTERS=$${SACA_AGREEMENT_ENCOUNTERS:-4000} $(release)/modules/eval/eval_test --gtest_filter='RolloutAgreement.*'
	SACA_SOAK_HOURS=$${SACA_SOAK_HOURS:-24} $(release)/modules/runtime/runtime_test --gtest_filter='LongDrive.*'
	SACA_SOAK_REACH=1 $(release)/modules/danger/danger_test --gtest_filter='FollowAgreement.*'
	SACA_SOAK_AIR3D=1 $(release)/modules/levelset/levelset_test --gtest_filter='Air3dReference.*'
