#pragma once

#include "protocol/conversation.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace orb::protocol {

/// The content of a log, and what could not be read.
struct LogText {
  std::vector<LogLine> lines;
  std::size_t read_lines = 0;     ///< lines other than blank lines and comments
  std::size_t strangers = 0;      ///< lines without bytes
  std::size_t first_stranger = 0; ///< the first of them, from 1
  std::string stranger;           ///< its text
};

/// Finds the bytes in logs of traffic with a robot: recordings (`> FF FF 00 …`), with a time in
/// front (`12:00:01.234 < FF FF …`, `[0.123] TX: 8d 0a …`), lines printed by spherov2.py (`request
/// 0x8d 0xa …`), bytes in Python's notation (`b'\x8d\n'`), and joined pairs as in `8d:0a:13:…`. `#`
/// begins a comment. Accepts any text.
LogText read_log(std::string_view text);

} // namespace orb::protocol
