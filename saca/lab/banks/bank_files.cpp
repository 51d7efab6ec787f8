#include "saca/lab/banks/bank_files.h"

#include <iterator>
#include <utility>

#include "saca/base/core/file.h"
#include "saca/base/formats/compressed_text.h"
#include "saca/lab/long_work/output_file.h"
#include "saca/thinking/memory/case_json.h"

namespace saca::banks {

Result<std::vector<memory::Case>> read_cases(const std::string& file) {
  const auto text = formats::read_compressed(file, many_bytes);
  if (!text.has_value()) {
    return text.error();
  }
  return memory::cases_from_text(text.value(), file);
}

Result<std::vector<memory::Case>> read_cases(const std::vector<std::string>& files) {
  std::vector<memory::Case> cases;
  for (const std::string& file : files) {
    auto more = read_cases(file);
    if (!more.has_value()) {
      return more.error();
    }
    std::vector<memory::Case> read = std::move(more).value();
    std::move(read.begin(), read.end(), std::back_inserter(cases));
  }
  return cases;
}

Result<std::vector<memory::Case>> shipped_cases(const std::filesystem::path& root) {
  return read_cases((root / "data/memory/seed.jsonl.gz").string());
}

Result<memory::Store> open_to_add(const std::string& file) {
  if (!memory::is_on_a_server(file)) {
    if (auto problem = long_work::make_folder_of(file)) {
      return *std::move(problem);
    }
  }
  return memory::Store::open(file);
}

Result<ReadBank> read_bank(const std::string& file) {
  auto store = memory::Store::open_existing(file);
  if (!store.has_value()) {
    return store.error();
  }
  memory::Store memory = std::move(store).value();
  auto cases = memory.all();
  if (!cases.has_value()) {
    return cases.error();
  }
  return ReadBank{std::move(memory), std::move(cases).value()};
}

}  // namespace saca::banks
