#include "editor/wire.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace orb::editor {
namespace {

std::vector<std::string> all(MessageReader& reader) {
  std::vector<std::string> found;
  while (const auto event = reader.next())
    found.push_back(event->is_error ? "fault: " + event->text : event->text);
  return found;
}

std::vector<std::string> read(std::string_view bytes) {
  MessageReader reader;
  reader.feed(bytes);
  return all(reader);
}

using List = std::vector<std::string>;

TEST(MessageReader, ReadsWhatFrameWrites) {
  EXPECT_EQ(read(frame("{}") + frame("") + frame("[1]")), (List{"{}", "", "[1]"}));
  EXPECT_EQ(read("content-length :2\r\nContent-Type: x\r\n\r\n{}"), List{"{}"});
  EXPECT_EQ(read("Content-Length: 2\n\n{}"), List{"{}"});
}

TEST(MessageReader, WaitsForTheRest) {
  EXPECT_EQ(read("Content-Length: 3\r\n\r\n{}"), List{});
  EXPECT_EQ(read("Content-Len"), List{});
}

TEST(MessageReader, GoesOnBehindABadHeader) {
  for (const auto* bad : {"Content-Length: -1", "Content-Length: 99999999999999999999", "x: y",
                          "Content-Length: 2x", "\x01\xFF", "Content-Length:"})
    EXPECT_EQ(read(std::string(bad) + "\r\n\r\n" + frame("{}")),
              (List{"fault: a header without a usable Content-Length", "{}"}))
        << bad;
}

TEST(MessageReader, SkipsAMessageThatIsTooLong) {
  const std::string body(MessageReader::max_message + 1, ' ');
  EXPECT_EQ(read(frame(body) + frame("{}")),
            (List{"fault: a message of 16777217 bytes; at most 16777216 are read", "{}"}));
}

TEST(MessageReader, GivesUpAHeaderWithoutEnd) {
  const auto found = read(std::string(3 * MessageReader::max_header, 'x'));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0], "fault: a header without an end");
}

RC_GTEST_PROP(MessageReader, CutsDoNotMatter, (std::vector<std::string> messages)) {
  std::string bytes;
  for (const auto& message : messages)
    bytes += frame(message);
  MessageReader reader;
  List found;
  while (!bytes.empty()) {
    const auto size = *rc::gen::inRange<std::size_t>(1, bytes.size() + 1);
    reader.feed(std::string_view(bytes).substr(0, size));
    bytes.erase(0, size);
    for (auto& one : all(reader))
      found.push_back(std::move(one));
  }
  RC_ASSERT(found == messages);
}

} // namespace
} // namespace orb::editor
