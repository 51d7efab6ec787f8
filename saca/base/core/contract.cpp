#include "saca/base/core/contract.h"

#include <string>

namespace saca {

void fail_contract(std::string_view rule, const char* function, const char* file, int line) {
  throw ContractViolation(std::string(function) + ": expects " + std::string(rule) + " (" + file +
                          ":" + std::to_string(line) + ")");
}

}  // namespace saca
