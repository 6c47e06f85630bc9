#pragma once

#include "vm/body/shove.h"
#include "vm/room/neighbours.h"

#include <span>
#include <vector>

namespace orb::vm {

/// Resolves contacts of balls at an instant and returns an entry for each ball. They have the same
/// mass; momentum is conserved, energy does not grow. Deeper contacts come first; ties keep the
/// order of `pairs`. Source: spec/ball.def (ball_restitution, least_blow, radius).
std::vector<Shove> contacts(std::span<const Mover> balls, std::span<const IndexPair> pairs);

} // namespace orb::vm
