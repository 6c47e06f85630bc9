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
/// but give no initial values, costs or growth: all figures are rows of spec/ball.def [?]. Source:
/// API §Refill Bank to §Level Up Attribute.
class Soul {
public:
  /// What a tick changed. Clients may subscribe to these changes.
  struct Changes {
    bool level = false;
    bool experience = false;
    bool boost = false;
    bool shield = false;
  };

  /// Fills a bank and returns the cores left; nullopt if there are too few.
  std::optional<std::uint32_t> refill(std::uint8_t bank);
  /// Buys consumables with cores. Returns false if there are too few cores, or if the count would
  /// exceed 255.
  bool buy(std::uint8_t consumable, std::uint8_t quantity);
  /// Uses one consumable. Returns false if none is left.
  bool use(std::uint8_t consumable);

  /// Starts a boost. Returns false if the bank is empty.
  bool start_boost();
  void stop_boost() { boosting_ = false; }
  bool boosting() const { return boosting_; }

  /// A blow drains part of the shield. Returns true if the shield changed.
  bool damage_shield();

  /// Advances one tick, due every spec::ball::soul_tick while changing() or while the ball moves:
  /// drive time earns experience, banks drain and regrow.
  Changes tick(bool moving);
  /// Returns true if values change even while the ball rests.
  bool changing() const;

  std::uint32_t cores() const { return cores_; }
  std::uint8_t count(std::uint8_t consumable) const { return consumables_[consumable]; }
  std::uint16_t level() const { return level_; }
  std::uint16_t points() const { return points_; }
  std::uint8_t boost() const { return static_cast<std::uint8_t>(boost_); }
  std::uint8_t shield() const { return static_cast<std::uint8_t>(shield_); }
  /// Progress to the next level, 0 to 255.
  std::uint8_t experience() const;

  /// Returns the block of spec::ssb_size bytes, in our own layout [?] (docs/reference/protocol.md).
  Bytes block() const;
  /// Loads a block. Returns false and changes nothing if it has another layout.
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
