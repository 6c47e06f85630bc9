#pragma once

#include "vm/body/shove.h"
#include "vm/room/neighbours.h"

#include <span>
#include <vector>

namespace orb::vm {

/// What balls that may touch do to one another at an instant: an entry for each ball. They weigh
/// the same. Momentum stays, energy does not grow. The deepest contact comes first, of equals the
/// one that `pairs` names first. Source: spec/ball.def (ball_restitution, least_blow, radius).
std::vector<Shove> contacts(std::span<const Mover> balls, std::span<const Pair> pairs);

} // namespace orb::vm
