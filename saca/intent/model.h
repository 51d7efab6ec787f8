#pragma once

namespace saca::intent {

/// What was learned about intentions. Nothing is learned yet: intentions are told by a rule, and
/// there is nothing to hold.
struct Model {};

}  // namespace saca::intent
