#include "saca/lab/long_work/output_file.h"

#include <system_error>

#include "saca/base/core/file.h"

namespace saca::long_work {

std::optional<Error> why_outputs_unwritable(std::initializer_list<std::filesystem::path> files) {
  for (const std::filesystem::path& file : files) {
    if (auto problem = file.empty() ? std::nullopt : why_unwritable(file)) {
      return problem;
    }
  }
  return std::nullopt;
}

std::optional<Error> write_output(const std::filesystem::path& file, std::string_view text) {
  const auto problem = make_folder_of(file);
  return problem ? problem : write_file(file, text);
}

std::optional<Error> make_folder_of(const std::filesystem::path& file) {
  std::error_code problem;
  if (file.has_parent_path()) {
    std::filesystem::create_directories(file.parent_path(), problem);
  }
  if (problem) {
    return Error{Error::Code::unwritable,
                 file.parent_path().string() + ": cannot be made: " + problem.message()};
  }
  return std::nullopt;
}

}  // namespace saca::long_work
