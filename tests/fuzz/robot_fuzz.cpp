// Robots at the level of bytes: whatever a client writes and the world does, two robots with the
// same input give the same output, however time is sliced, and a fork continues like its original.

#include "robot/robot.h"

#include <algorithm>
#include <cstdlib>
#include <string>

namespace {

using namespace orb;

/// Splits the input into actions; the first byte of each piece selects the action.
class Script {
public:
  explicit Script(ByteView rest) : rest_(rest) {}
  bool over() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty())
      return 0;
    const auto first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }
  ByteView piece() {
    const auto size = std::min<std::size_t>(byte(), rest_.size());
    const auto piece = rest_.first(size);
    rest_ = rest_.subspan(size);
    return piece;
  }

private:
  ByteView rest_;
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t longest = 400; // bytes: longer inputs only take longer
  Script script(ByteView(data, std::min(size, longest)));
  const auto kind = spec::robots[script.byte() % spec::robots.size()].robot;
  robot::Options options;
  options.keep = static_cast<robot::Keep>(script.byte() % 2);
  robot::Robot whole(kind, options);
  robot::Robot pieces(kind, options);
  whole.connect();
  pieces.connect();
  Bytes said;
  Bytes said_in_pieces;
  const auto hear = [](robot::Robot& robot, Bytes& into) {
    const auto bytes = robot.read();
    into.insert(into.end(), bytes.begin(), bytes.end());
  };
  while (!script.over()) {
    const auto what = script.byte();
    if (what % 4 == 0) {
      const auto bytes = script.piece();
      whole.write(bytes);
      pieces.write(bytes);
    } else if (what % 4 == 1) {
      const auto line = script.piece();
      const std::string text(line.begin(), line.end());
      if (whole.stimulus(text).has_value() != pieces.stimulus(text).has_value())
        std::abort();
    } else {
      const auto time = std::chrono::milliseconds{script.byte() * 4};
      whole.advance(time);
      for (int i = 0; i < 4; ++i) {
        pieces.advance(time / 4);
        hear(pieces, said_in_pieces);
      }
    }
    hear(whole, said);
    hear(pieces, said_in_pieces);
  }
  if (said != said_in_pieces)
    std::abort();
  if (const auto fork = whole.fork()) {
    fork->advance(std::chrono::seconds{1});
    whole.advance(std::chrono::seconds{1});
    if (fork->read() != whole.read() || fork->state().pose.x_cm != whole.state().pose.x_cm)
      std::abort();
  }
  return 0;
}
