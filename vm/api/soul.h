#pragma once

#include "base/bytes.h"
#include "base/time.h"
#include "spec/api.h"
#include "spec/ball.h"

#include <array>
#include <cstdint>
#include <optional>

namespace orb::vm {

/// The game values of the soul block: cores, consumables, banks, levels. The documents name them
/// and give neither starting values nor costs nor growth: all figures are rows of spec/ball.def
/// [?]. Source: API §Refill Bank to §Level Up Attribute.
class Soul {
public:
  /// What changed during a tick, for the messages that clients may ask for.
  struct Changes {
    bool level = false;
    bool experience = false;
    bool boost = false;
    bool shield = false;
  };

  /// A bank filled for cores; nothing where there are too few.
  std::optional<std::uint32_t> refill(std::uint8_t bank);
  /// Cores spent on consumables; false where there are too few, or there would be more than 255.
  bool buy(std::uint8_t consumable, std::uint8_t quantity);
  /// One consumable less; false when none is left.
  bool use(std::uint8_t consumable);

  /// Boosting starts only while the bank holds something.
  bool start_boost();
  void stop_boost() { boosting_ = false; }
  bool boosting() const { return boosting_; }

  /// A blow takes a part of the shield. True where there was something to take.
  bool damage_shield();

  /// One tick, due every spec::ball::soul_tick while changing() or while the ball moves: drive time
  /// earns experience, banks drain and grow back.
  Changes tick(bool moving);
  /// Whether something goes on without the ball moving.
  bool changing() const;

  std::uint32_t cores() const { return cores_; }
  std::uint8_t count(std::uint8_t consumable) const { return consumables_[consumable]; }
  std::uint16_t level() const { return level_; }
  std::uint16_t points() const { return points_; }
  std::uint8_t boost() const { return static_cast<std::uint8_t>(boost_); }
  std::uint8_t shield() const { return static_cast<std::uint8_t>(shield_); }
  /// Progress to the next level, of 255.
  std::uint8_t experience() const;

  /// The block of spec::ssb_size bytes; its layout is ours [?] (docs/protocol.md).
  Bytes block() const;
  /// Takes over a block; false, and nothing changed, where it is none of ours.
  bool load(ByteView block);

private:
  static constexpr int full = spec::ball::greatest;

  std::uint32_t cores_ = spec::ball::first_cores;
  std::array<std::uint8_t, spec::soul_at::LastConsumable - spec::soul_at::FirstConsumable + 1>
      consumables_{};
  std::array<std::uint8_t, spec::soul_at::LastAttribute - spec::soul_at::FirstAttribute + 1>
      attributes_{1, 1, 1, 1};
  std::uint16_t level_ = 1;
  std::uint16_t points_ = 0;
  std::uint32_t drive_s_ = 0; ///< toward the next level
  int boost_ = full;
  int shield_ = full;
  bool boosting_ = false;
};

} // namespace orb::vm
