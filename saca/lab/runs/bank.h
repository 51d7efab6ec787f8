#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "saca/base/core/result.h"
#include "saca/thinking/memory/case.h"
#include "saca/thinking/memory/store.h"

namespace saca::runs {

/// What a run does with its memory.
enum class BankUse : std::uint8_t {
  ask,              ///< of what it holds now; nothing is added
  learn,            ///< what happens is added; an empty bank begins with what is shipped
  learn_from_empty  ///< likewise, but an empty bank stays empty
};

/// The memory bank of a run.
struct BankRequest {
  std::string place;  ///< a file, or a bank on a server
  BankUse use = BankUse::learn;
  std::vector<memory::MadeWith> car;  ///< that asks it
  std::function<Result<std::vector<memory::Case>>()>
      shipped;  ///< cases that an empty bank begins with; called only where it does
};

/// Opens it, or makes it where it is to learn.
/// @return  what cannot be opened, with the way to do without; unreadable where the folder of a
///          file is missing
[[nodiscard]] Result<std::shared_ptr<memory::Store>> open_bank(const BankRequest& request);

}  // namespace saca::runs
