#pragma once

#include "base/diagnostic.h"
#include "protocol/conversation.h"
#include "protocol/judge/order.h"
#include "spec/robots.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace orb::protocol {

/// A place where a client did something.
struct Occurrence {
  std::string when;
  std::size_t number = 0; ///< line or frame; 0: none
  Bytes raw;              ///< the packet
};

/// A mistake or possible improvement of a client, in one or several places.
struct Mistake {
  const Rule* rule = nullptr;
  Severity severity = Severity::Error;
  Message message;
  Message help;
  std::size_t count = 0;
  std::vector<Occurrence> places; ///< the first of them
};

struct Judgement {
  std::size_t commands = 0; ///< from the client
  std::size_t answers = 0;  ///< from the robot
  std::vector<Mistake> mistakes;

  /// Returns true if there is nothing worse than notes.
  bool is_clean() const;
};

/// How a conversation ended.
enum class Ending : std::uint8_t {
  Over,   ///< client and robot disconnected
  Unseen, ///< the log ends first
};

/// Judges what a client says to a robot, line by line. Silent in case of doubt: of a conversation
/// without its beginning it knows less. Large because it reads both versions of packets and
/// remembers what was sent, answered, driven and put to sleep.
class ClientJudge {
public:
  /// `about` describes the conversation; its lines are ignored. `awake`: whether the robot may have
  /// been woken before.
  enum class Awake : std::uint8_t { No, Perhaps, Yes };
  ClientJudge(const Conversation& about, spec::Packets packets, Awake awake);

  /// Takes a line with known direction.
  void take(const LogLine& line);
  /// Ends the conversation. Returns the mistakes, most severe first.
  Judgement end(Ending ending);

private:
  struct Open {
    Order order;
    Occurrence place;
    std::optional<Duration> at;
    bool was_passed = false;  ///< a later command has been answered
    bool was_damaged = false; ///< it arrived damaged
  };
  struct Sent {
    std::optional<Duration> at;
    std::uint32_t key = 0;
    bool is_answered = false;
  };
  /// A command that moved or stopped the robot.
  struct Moved {
    Order order;
    Occurrence place;
    std::optional<Duration> at;
  };
  struct Asked {
    std::size_t count = 0;
    std::optional<Duration> first, last;
    std::string_view instead;
    Occurrence place;
  };

  void take_v1(Direction direction);
  void take_v2(Direction direction);
  void obey(const Order& order, const std::optional<Refusal>& silent, ByteView raw);
  void hear(const Reply& reply, ByteView raw);
  void damaged(Order order, std::uint8_t wrong, std::uint8_t right, ByteView raw);
  void noise(ByteView raw);
  void check_greeting(const Order& order, const Occurrence& place);
  void check_sequence(const Order& order, const Occurrence& place);
  void check_pace(const Order& order, const Occurrence& place);
  void check_awake(const Order& order, const Occurrence& place);
  void follow(const Order& order, const Occurrence& place);
  void sleep();
  void refuse(const Order& order, const Refusal& refusal, const Occurrence& place,
              Severity severity);
  void judge_end(Ending ending);

  Occurrence here(ByteView raw) const;
  void add(const Rule& rule, Severity severity, Message message, Message help, Occurrence place);

  Conversation about_;
  spec::Packets packets_;
  Judgement judgement_;

  Decoder to_ball_{Direction::ToBall};
  Decoder from_ball_{Direction::FromBall};
  DecoderV2 to_ball_v2_;
  DecoderV2 from_ball_v2_;
  std::size_t seen_ = 0; ///< following bytes that belong to a damaged packet

  LogLine line_;   ///< the present line, without its bytes
  LogLine client_; ///< the client's last line, likewise
  std::vector<Open> open_;
  std::optional<Sent> last_;
  std::optional<Moved> drives_;
  std::optional<Moved> stops_; ///< not acknowledged yet
  std::map<std::string, Asked> asked_;
  Awake awake_;
  bool was_put_to_sleep_ = false;
  bool is_greeted_ = false;
  bool ends_safely_ = false;
  bool robot_spoke_ = false;
};

/// Judges a whole conversation.
Judgement judge(const Conversation& conversation, spec::Packets packets,
                ClientJudge::Awake awake = ClientJudge::Awake::No);

} // namespace orb::protocol
