#pragma once

#include "protocol/decoder.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orb::protocol {

/// A line of a log: the bytes of one write or read.
struct LogLine {
  std::string when;                   ///< its time, as it stands there; empty without one
  std::optional<Direction> direction; ///< where the line tells
  Bytes bytes;
};

/// What a log holds, and what could not be read of it.
struct LogText {
  std::vector<LogLine> lines;
  std::size_t read_lines = 0;     ///< all that are not empty and no comments
  std::size_t strangers = 0;      ///< those in which no bytes were found
  std::size_t first_stranger = 0; ///< its line, from 1
  std::string stranger;           ///< its text
};

/// Finds the bytes in logs of traffic with a robot: recordings (`> FF FF 00 …`), with a time in
/// front (`12:00:01.234 < FF FF …`, `[0.123] TX: 8d 0a …`), the lines that spherov2.py prints
/// (`request 0x8d 0xa …`), bytes as Python shows them (`b'\x8d\n'`), pairs joined as in
/// `8d:0a:13:…`. `#` begins a comment. Any text may come.
LogText read_log(std::string_view text);

} // namespace orb::protocol
