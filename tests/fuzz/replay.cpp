// Runs a fuzzer's entry on every file of the folders given: with any compiler, in ctest.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "saca/base/core/file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv) {
  std::size_t num_files = 0;
  for (int i = 1; i < argc; ++i) {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) {
      if (entry.is_directory()) {
        continue;
      }
      const saca::Result<std::string> text = saca::read_file(entry.path());
      if (!text.has_value()) {
        std::fprintf(stderr, "%s\n", text.error().message.c_str());
        return 1;
      }
      (void)LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.value().data()),
                                   text.value().size());
      ++num_files;
    }
  }
  std::printf("%zu files\n", num_files);
  return num_files > 0 ? 0 : 1;
}
