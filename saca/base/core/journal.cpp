#include "saca/base/core/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>
#include <utility>

#include "saca/base/core/contract.h"
#include "saca/base/core/file.h"

namespace saca {

namespace fs = std::filesystem;

Result<Journal> Journal::open(const fs::path& path, const std::string& title) {
  expects(title.find('\n') == std::string::npos, "the title is one line");
  Journal journal;
  const std::string first = title + "\n";
  std::string text;
  if (fs::exists(path)) {
    const auto read = read_file(path, many_bytes);
    if (!read.has_value()) {
      return read.error();
    }
    text = read.value().substr(0, read.value().rfind('\n') + 1);
  }
  if (!text.empty() && !text.starts_with(first)) {
    return Error{Error::Code::malformed,
                 path.string() + ": is the journal of \"" + text.substr(0, text.find('\n')) +
                     "\", not of \"" + title + "\": remove it, or ask for what it was begun with"};
  }
  std::istringstream lines(text.substr(std::min(text.size(), first.size())));
  for (std::string line; std::getline(lines, line);) {
    journal.lines_.push_back(line);
  }
  if (auto problem = write_file(path, text.empty() ? first : text)) {
    return *problem;
  }
  journal.file_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (journal.file_ < 0) {
    return Error{Error::Code::unwritable, path.string() + ": " + std::strerror(errno)};
  }
  return journal;
}

Journal::Journal(Journal&& other) noexcept
    : lines_(std::move(other.lines_)), file_(std::exchange(other.file_, -1)) {}

Journal::~Journal() {
  if (file_ >= 0) {
    ::close(file_);
  }
}

bool Journal::add(std::string_view line) const {
  expects(line.find('\n') == std::string_view::npos, "one line");
  const std::string whole = std::string(line) + "\n";
  return ::write(file_, whole.data(), whole.size()) == static_cast<ssize_t>(whole.size());
}

}  // namespace saca
