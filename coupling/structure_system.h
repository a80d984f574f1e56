/// The moving structures of a coupled system as one linear system, for its largest frequency
/// (coupling/README.md, Time step).
#pragma once

#include "coupling/exchange.h"
#include "dem/assembly/largest_frequency.h"

#include <vector>

namespace mergel::coupling {

/// The amplitudes of the structures one after the other.
class StructureSystem final : public dem::WallSystem {
public:
  /// A structure that moves, and the wall of the assembly that it moves. Borrowed.
  struct Part {
    const Structure* structure;
    const Transfer* transfer;
    std::size_t wall;
  };
  explicit StructureSystem(std::vector<Part> parts) : parts_(std::move(parts)) {}

  std::size_t size() const override;
  void move(std::span<const double> y,
            std::vector<std::vector<dem::Vec3>>& u) const override;
  void multiply(std::span<const double> y, const std::vector<std::vector<dem::Vec3>>& f,
                std::span<double> to) const override;

  /// The largest local damping of its parts [-].
  double damping() const;

private:
  std::vector<Part> parts_;
};

} // namespace mergel::coupling
