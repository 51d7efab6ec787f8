#include "saca/lab/runs/bank.h"

#include <fmt/core.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace saca::runs {
namespace {

namespace fs = std::filesystem;

Error with_a_way_out(const BankRequest& request, const Error& error) {
  const bool may_be_moved = request.use != BankUse::ask && !memory::is_on_a_server(request.place);
  return {error.code, error.message + " (" + (may_be_moved ? "move the file away, or " : "") +
                          "run without --memory)"};
}

}  // namespace

Result<std::shared_ptr<memory::Store>> open_bank(const BankRequest& request) {
  const bool learns = request.use != BankUse::ask;
  const fs::path folder =
      memory::is_on_a_server(request.place) ? fs::path() : fs::path(request.place).parent_path();
  std::error_code problem;
  if (learns && !folder.empty() && !fs::is_directory(folder, problem)) {
    return Error{Error::Code::unreadable,
                 fmt::format("--memory {}: want a folder that is there, got {}", request.place,
                             folder.string())};
  }
  auto opened = learns ? memory::Store::open(request.place, request.car)
                       : memory::Store::snapshot(request.place, request.car);
  if (!opened.has_value()) {
    return with_a_way_out(request, opened.error());
  }
  auto store = std::make_shared<memory::Store>(std::move(opened).value());
  if (store->size() == 0 && request.use == BankUse::learn) {
    const auto cases = request.shipped();
    if (!cases.has_value()) {
      return cases.error();
    }
    if (const auto failed = store->begin_with(cases.value())) {
      return with_a_way_out(request, *failed);
    }
  }
  return store;
}

}  // namespace saca::runs
