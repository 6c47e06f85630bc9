// Device 02h: option flags, modes, configuration block and soul block.

#include "base/random.h"
#include "spec/ball.h"
#include "vm/api/dispatch.h"

#include <utility>

namespace orb::vm {
namespace {

using spec::ResponseCode;

using namespace spec::ball;

constexpr std::uint32_t assigned_temporary_flags = spec::temporary_option_flags::stop_on_disconnect;

std::uint16_t chassis_id(std::uint64_t seed) {
  return static_cast<std::uint16_t>(chassis_base + seed % chassis_range);
}

} // namespace

HANDLE(GetApplicationConfigurationBlock) {
  return call.answer({ByteView{}}); // nothing is ever stored here
}

HANDLE(ReenableDemoMode) {
  return {};
}

HANDLE(GetChassisId) {
  return call.answer({chassis_id(seed_)});
}

HANDLE(SetPermanentOptionFlags) {
  host_->set(&Settings::permanent_flags, static_cast<std::uint32_t>(call.operands.number(0)));
  watch_gyro();
  persist();
  return {};
}

HANDLE(GetPermanentOptionFlags) {
  return call.answer({host_->settings().permanent_flags});
}

HANDLE(SetTemporaryOptionFlags) {
  host_->set(&Settings::temporary_flags,
             static_cast<std::uint32_t>(call.operands.number(0)) & assigned_temporary_flags);
  return {};
}

HANDLE(GetTemporaryOptionFlags) {
  return call.answer({host_->settings().temporary_flags});
}

HANDLE(GetConfigurationBlock) {
  Bytes block;
  if (call.operands.u8(0) == factory_block) {
    // The factory block: the settings of a new ball, with its chassis id at the end [?].
    block = config_block({}, {});
    block.resize(spec::config_block_size - sizeof(std::uint16_t));
    append_u16(block, chassis_id(seed_));
  } else {
    block = config_block(host_->settings(), profile_);
  }
  host_->send(protocol::make_async(spec::AsyncId::ConfigBlock, {block}));
  return {};
}

HANDLE(SetConfigurationBlock) {
  auto settings = host_->settings();
  if (!load_config_block(call.operands.data(), settings, profile_))
    return {ResponseCode::BadParameter, {}};
  host_->change(settings);
  watch_gyro();
  persist();
  return {};
}

HANDLE(SetDeviceMode) {
  device_mode_ = call.operands.u8(0);
  return {};
}

HANDLE(GetDeviceMode) {
  return call.answer({device_mode_});
}

HANDLE(GetSsb) {
  host_->send(protocol::make_async(spec::AsyncId::SoulBlock, {profile_.soul.block()}));
  return {};
}

HANDLE(RefillBank) {
  const auto bank = call.operands.u8(0);
  const auto cores = profile_.soul.refill(bank);
  if (!cores)
    return {ResponseCode::ExecuteFailed, {}};
  persist();
  if (soul_messages_) {
    const auto is_boost = bank == spec::bank::boost;
    host_->send(
        protocol::make_async(is_boost ? spec::AsyncId::BoostUpdate : spec::AsyncId::ShieldDamage,
                             {is_boost ? profile_.soul.boost() : profile_.soul.shield()}));
  }
  return call.answer({*cores});
}

HANDLE(BuyConsumable) {
  const auto consumable = call.operands.u8(0);
  if (!profile_.soul.buy(consumable, call.operands.u8(1)))
    return {ResponseCode::ExecuteFailed, {}};
  persist();
  return call.answer({profile_.soul.count(consumable), profile_.soul.cores()});
}

HANDLE(UseConsumable) {
  const auto consumable = call.operands.u8(0);
  if (host_->now() < consumable_until_ || !profile_.soul.use(consumable))
    return {ResponseCode::ExecuteFailed, {}};
  consumable_until_ = host_->now() + consumable_time;
  return call.answer({consumable, profile_.soul.count(consumable)});
}

HANDLE(GetPasswordSeed) {
  return call.answer({seed_ * Random::stride >> 32});
}

HANDLE(EnableSsbAsync) {
  soul_messages_ = call.operands.u8(0) != 0;
  return {};
}

} // namespace orb::vm
