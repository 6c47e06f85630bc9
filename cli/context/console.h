#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <utility>
#include <vector>

// The standard streams of this process and what they are connected to.

namespace orb::cli {

enum class Stream : std::uint8_t { In, Out, Err };

/// Prepares the streams. Returns the words of the command line in UTF-8, the program's name first.
std::vector<std::string> begin_process(int argc, char** argv);

/// Returns true if the stream is a terminal.
bool is_terminal(Stream stream);
/// Returns true if it is a terminal with colours and cursor movement.
bool can_draw(Stream stream);

/// Returns true if read_input() would not block.
bool input_waits();
/// Reads from standard input like read(2): returns the number of bytes, 0 at the end.
ssize_t read_input(std::span<char> bytes);

/// Writes to standard output or error, unbuffered; returns false and sets errno on failure.
bool write_to(Stream stream, std::string_view text);

/// Rows and columns of the terminal on standard error; 24 and 80 if unknown.
std::pair<std::size_t, std::size_t> screen();

/// Ends the process silently if a write error says that the reader has left; else returns.
void end_if_unread(int error);

/// Makes a new private folder for this user; nothing if that fails.
std::optional<std::string> make_temporary_folder();

} // namespace orb::cli
