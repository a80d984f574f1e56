/// A failure that all ranks meet together.
#pragma once

#include "dem/error.h"

namespace mergel {

/// Every rank throws it alike: the first may speak for all, and all can leave in order.
struct CollectiveFailure : NumericalError {
  using NumericalError::NumericalError;
};

} // namespace mergel
