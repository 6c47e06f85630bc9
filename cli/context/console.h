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

// The streams that this process was given, and what is at their other end.

namespace orb::cli {

enum class Stream : std::uint8_t { In, Out, Err };

/// Makes the streams ready; the words of the command line in UTF-8, the program's name first.
std::vector<std::string> begin_process(int argc, char** argv);

/// Whether a person is at its other end.
bool is_terminal(Stream stream);
/// The same, where that terminal also has colours and lines that can be drawn over.
bool can_draw(Stream stream);

/// Whether read_input() would come back at once.
bool input_waits();
/// As read(2) from standard input, in pieces as they come: how many bytes, 0 at the end.
ssize_t read_input(std::span<char> bytes);

/// Writes to standard output or error, at once; false with errno where that fails.
bool write_to(Stream stream, std::string_view text);

/// Rows and columns of the terminal that standard error is; 24 and 80 where nobody knows.
std::pair<std::size_t, std::size_t> screen();

/// Where an error of writing says that the reader has left, the process ends as programs do then:
/// without a word. Else this returns.
void end_if_unread(int error);

/// A new folder that nobody else has, for files of this user; nothing where none can be made.
std::optional<std::string> make_temporary_folder();

} // namespace orb::cli
