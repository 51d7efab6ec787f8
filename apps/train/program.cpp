#include "apps/train/program.h"

#include <fmt/core.h>
#include <torch/torch.h>

#include <cmath>
#include <csignal>
#include <cstdio>

#include "saca/base/core/file.h"
#include "saca/base/core/standard_files.h"
#include "saca/lab/network_training/blas.h"

namespace saca::train_program {
namespace {

volatile std::sig_atomic_t was_told_to_stop = 0;

}  // namespace

void begin(char** argv) {
  network_training::give_each_thread_its_own_products(argv);
  occupy_standard_files();
  torch::set_num_threads(1);
  std::signal(SIGINT, [](int) { was_told_to_stop = 1; });
}

bool is_to_stop() {
  return was_told_to_stop != 0;
}

int failed(std::string_view program, const Error& error) {
  fmt::print(stderr, "{}: error: {}\n", program, error.message);
  constexpr int bad_input = 3;
  constexpr int cannot_write = 4;
  return error.code == Error::Code::unwritable ? cannot_write : bad_input;
}

bool show_epoch(const network_training::Epoch& now, int epochs) {
  fmt::print("epoch {} of {}: loss {:.4f}, held out {:.4f}, {:.1f} s\n", now.number, epochs,
             now.loss, now.held_out.value_or(std::nan("")), now.seconds);
  std::fflush(stdout);
  return !is_to_stop();
}

std::optional<Error> write_trained(const std::string& output, const formats::Tensors& weights,
                                   std::string_view curve) {
  if (auto problem = write_file(output, formats::tensor_bytes(weights))) {
    return problem;
  }
  return write_file(output + ".curve.csv", curve);
}

int stopped(std::string_view program) {
  fmt::print(stderr, "{}: stopped; the same command goes on from here\n", program);
  constexpr int interrupted = 130;
  return interrupted;
}

}  // namespace saca::train_program
