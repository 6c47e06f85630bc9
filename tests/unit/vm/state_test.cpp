#include "vm/state.h"

#include "vm/ball.h"

#include <gtest/gtest.h>

namespace orb::vm {
namespace {

void send(Ball& ball, spec::ApiCommand command, Bytes data) {
  ball.receive(encode(protocol::make_command(command, std::move(data))));
}

TEST(State, WhatOutlivesAPowerCycleComesBack) {
  Ball first(BallOptions{});
  first.connect();
  send(first, spec::ApiCommand::SetDeviceName, {'R', 'e', 'd'});
  send(first, spec::ApiCommand::SetRgbLed, {1, 2, 3, 1});
  send(first, spec::ApiCommand::SetPermanentOptionFlags, {0, 0, 0, 0x10});
  send(first, spec::ApiCommand::SetInactivityTimeout, {0, 90});
  send(first, spec::ApiCommand::BuyConsumable, {2, 3});
  const std::string program("10 print 1\n\0", 12);
  first.append_basic(Area::Flash, as_bytes(program));
  first.append_basic(Area::Ram, as_bytes("10 end\n"));

  Ball second(BallOptions{});
  const auto loaded = load_state(save_state(first), second);
  ASSERT_TRUE(loaded) << loaded.error();
  EXPECT_EQ(second.profile().name, "Red");
  EXPECT_EQ(second.settings().user_color, (Color{1, 2, 3}));
  EXPECT_EQ(second.settings().permanent_flags, 0x10u);
  EXPECT_EQ(second.settings().inactivity_timeout, 90s);
  EXPECT_EQ(second.profile().soul.count(2), 3);
  EXPECT_EQ(second.basic_text(Area::Flash), program);
  EXPECT_EQ(second.basic_text(Area::Ram), "");
  EXPECT_EQ(second.profile().cold_boots, 2);
}

TEST(State, ATornFileIsRefusedAndChangesNothing) {
  Ball first(BallOptions{});
  first.append_basic(Area::Flash, as_bytes("10 end\n"));
  const auto text = save_state(first);
  for (std::size_t size = 0; size + 1 < text.size(); size += 7) {
    Ball second(BallOptions{});
    EXPECT_FALSE(load_state(text.substr(0, size), second)) << size;
    EXPECT_EQ(second.basic_text(Area::Flash), "");
  }
}

} // namespace
} // namespace orb::vm
