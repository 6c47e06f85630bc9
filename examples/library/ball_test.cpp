// Drives the virtual ball with packets, as the test of a client library would.
#include <orb/compiler/load.h>
#include <orb/protocol/decoder.h>
#include <orb/vm/ball.h>

#include <gtest/gtest.h>

using namespace std::chrono_literals;

namespace {

// Sends one command and returns what comes back within a tenth of a second.
orb::protocol::Response answer_to(orb::vm::Ball& ball, orb::spec::ApiCommand command,
                                  orb::Bytes data = {}) {
  ball.receive(encode(orb::protocol::make_command(command, std::move(data), 7)));
  ball.advance_to(ball.now() + 100ms);
  const auto bytes = ball.take_output();
  orb::protocol::Decoder decoder(orb::protocol::Direction::FromBall);
  decoder.feed(bytes);
  while (const auto item = decoder.next())
    if (item->kind == orb::protocol::Item::Kind::Response)
      return item->response();
  ADD_FAILURE() << "no answer";
  return {};
}

TEST(Ball, AnswersAPing) {
  orb::vm::Ball ball({});
  ball.connect();
  const auto answer = answer_to(ball, orb::spec::ApiCommand::Ping);
  EXPECT_EQ(answer.code, 0); // ORBOTIX_RSP_CODE_OK
  EXPECT_EQ(answer.seq, 7);
}

TEST(Ball, KeepsItsColour) {
  orb::vm::BallOptions options;
  options.loader = orb::compiler::load; // so that it can run programs, too
  orb::vm::Ball ball(options);
  ball.connect();
  answer_to(ball, orb::spec::ApiCommand::SetRgbLed, {255, 0, 0, 1}); // 1: for good
  EXPECT_EQ(answer_to(ball, orb::spec::ApiCommand::GetRgbLed).data, (orb::Bytes{255, 0, 0}));
}

} // namespace
