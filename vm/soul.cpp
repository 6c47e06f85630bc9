#include "vm/soul.h"

#include <algorithm>

namespace orb::vm {
namespace {

// No document gives these figures: each is a choice [?].
constexpr std::uint32_t refill_cost = 10;     // cores
constexpr std::uint32_t consumable_cost = 25; // cores apiece
constexpr std::uint32_t level_time_s = 60;    // drive time from level 1 to 2; n times that from n
constexpr std::uint16_t points_per_level = 1;
constexpr int boost_drain = 51;  // of 255, each tick of boosting: five seconds
constexpr int boost_growth = 17; // fifteen seconds to full
constexpr int shield_growth = 5;
constexpr int shield_damage = 32; // each collision
constexpr std::uint8_t block_version = 1;

} // namespace

std::optional<std::uint32_t> Soul::refill(std::uint8_t bank) {
  if (cores_ < refill_cost)
    return std::nullopt;
  cores_ -= refill_cost;
  (bank == spec::bank::boost ? boost_ : shield_) = full;
  return cores_;
}

bool Soul::buy(std::uint8_t consumable, std::uint8_t quantity) {
  const auto cost = consumable_cost * quantity;
  auto& count = consumables_[consumable];
  if (cores_ < cost || count + quantity > UINT8_MAX)
    return false;
  cores_ -= cost;
  count = static_cast<std::uint8_t>(count + quantity);
  return true;
}

bool Soul::use(std::uint8_t consumable) {
  auto& count = consumables_[consumable];
  if (count == 0)
    return false;
  --count;
  return true;
}

bool Soul::start_boost() {
  boosting_ = boost_ > 0;
  return boosting_;
}

bool Soul::damage_shield() {
  if (shield_ == 0)
    return false;
  shield_ = std::max(0, shield_ - shield_damage);
  return true;
}

bool Soul::changing() const {
  return boosting_ || boost_ < full || shield_ < full;
}

Soul::Changes Soul::tick(bool moving) {
  Changes changes;
  const auto boost_before = boost_;
  const auto shield_before = shield_;
  const auto experience_before = experience();
  boost_ = std::clamp(boost_ + (boosting_ ? -boost_drain : boost_growth), 0, full);
  boosting_ = boosting_ && boost_ > 0;
  shield_ = std::min(full, shield_ + shield_growth);
  if (moving && ++drive_s_ >= level_time_s * level_) {
    drive_s_ = 0;
    ++level_;
    points_ = static_cast<std::uint16_t>(points_ + points_per_level);
    changes.level = true;
  }
  changes.boost = boost_ != boost_before;
  changes.shield = shield_ != shield_before;
  changes.experience = experience() != experience_before;
  return changes;
}

std::uint8_t Soul::experience() const {
  return static_cast<std::uint8_t>(
      std::min<std::uint32_t>(full, drive_s_ * full / (level_time_s * level_)));
}

Bytes Soul::block() const {
  Bytes out{block_version};
  append_u32(out, cores_);
  append_u16(out, level_);
  append_u16(out, points_);
  append_u32(out, drive_s_);
  out.push_back(boost());
  out.push_back(shield());
  out.insert(out.end(), consumables_.begin(), consumables_.end());
  out.insert(out.end(), attributes_.begin(), attributes_.end());
  out.resize(spec::ssb_size);
  return out;
}

bool Soul::load(ByteView block) {
  if (block.size() != spec::ssb_size || block[0] != block_version || read_u16(block, 5) == 0)
    return false;
  cores_ = read_u32(block, 1);
  level_ = read_u16(block, 5);
  points_ = read_u16(block, 7);
  drive_s_ = std::min(read_u32(block, 9), level_time_s * level_ - 1);
  boost_ = block[13];
  shield_ = block[14];
  std::copy_n(block.begin() + 15, consumables_.size(), consumables_.begin());
  std::copy_n(block.begin() + 15 + static_cast<std::ptrdiff_t>(consumables_.size()),
              attributes_.size(), attributes_.begin());
  boosting_ = false;
  return true;
}

} // namespace orb::vm
