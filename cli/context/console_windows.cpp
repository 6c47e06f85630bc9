#include "cli/context/console.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <io.h>
#include <mutex>
#include <thread>
#include <windows.h>

#include <shellapi.h> // needs windows.h

namespace orb::cli {
namespace {

HANDLE handle(Stream stream) {
  switch (stream) {
  case Stream::In: return ::GetStdHandle(STD_INPUT_HANDLE);
  case Stream::Out: return ::GetStdHandle(STD_OUTPUT_HANDLE);
  case Stream::Err: break;
  }
  return ::GetStdHandle(STD_ERROR_HANDLE);
}

/// Reads standard input ahead on its own thread, because the system does not always tell if input
/// is waiting: Wine does not for Unix pipes.
class ReadAhead {
public:
  ReadAhead() {
    std::thread([this] { fill(); }).detach(); // it may block until the process ends
  }

  bool waits() {
    const std::lock_guard lock(mutex_);
    return ended_ || !bytes_.empty();
  }

  ssize_t read(std::span<char> bytes) {
    std::unique_lock lock(mutex_);
    came_.wait(lock, [this] { return ended_ || !bytes_.empty(); });
    const auto size = std::min(bytes.size(), bytes_.size());
    std::copy_n(bytes_.begin(), size, bytes.begin());
    bytes_.erase(0, size);
    return static_cast<ssize_t>(size);
  }

private:
  void fill() {
    std::array<char, 4096> piece{};
    int size = 0;
    while ((size = ::_read(0, piece.data(), piece.size())) > 0) {
      const std::lock_guard lock(mutex_);
      bytes_.append(piece.data(), static_cast<std::size_t>(size));
      came_.notify_one();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    came_.notify_one();
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::string bytes_;
  bool ended_ = false;
};

ReadAhead* ahead = nullptr; ///< never freed: its thread may block forever

UINT code_page_before = 0;

/// Restores the code page: the console outlives this process.
void give_back_code_page() {
  ::SetConsoleOutputCP(code_page_before);
}

std::string in_utf8(const wchar_t* text) {
  const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<std::size_t>(size), '\0');
  ::WideCharToMultiByte(CP_UTF8, 0, text, -1, out.data(), size, nullptr, nullptr);
  out.pop_back(); // the terminating zero
  return out;
}

std::wstring in_utf16(std::string_view text) {
  const int size = static_cast<int>(text.size());
  std::wstring out(text.size(), L'\0');
  out.resize(static_cast<std::size_t>(
      ::MultiByteToWideChar(CP_UTF8, 0, text.data(), size, out.data(), size)));
  return out;
}

} // namespace

std::vector<std::string> begin_process(int argc, char** argv) {
  for (const int fd : {0, 1, 2})
    ::_setmode(fd, _O_BINARY); // no line end conversion
  if (is_terminal(Stream::Out) || is_terminal(Stream::Err)) {
    code_page_before = ::GetConsoleOutputCP();
    ::SetConsoleOutputCP(CP_UTF8);
    std::atexit(give_back_code_page);
  }
  for (const auto stream : {Stream::Out, Stream::Err})
    if (DWORD mode = 0; ::GetConsoleMode(handle(stream), &mode) != 0)
      ::SetConsoleMode(handle(stream), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  int count = 0;
  wchar_t** const words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  if (words == nullptr)
    return {argv, argv + argc};
  std::vector<std::string> all;
  for (int i = 0; i < count; ++i)
    all.push_back(in_utf8(words[i]));
  ::LocalFree(words);
  return all;
}

bool is_terminal(Stream stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(handle(stream), &mode) != 0;
}

bool can_draw(Stream stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(handle(stream), &mode) != 0 &&
         (mode & ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

bool input_waits() {
  if (ahead != nullptr)
    return ahead->waits();
  const auto in = handle(Stream::In);
  DWORD count = 0;
  if (::GetFileType(in) == FILE_TYPE_PIPE) {
    if (::PeekNamedPipe(in, nullptr, 0, nullptr, &count, nullptr) != 0)
      return count > 0;
    if (::GetLastError() != ERROR_NOT_SUPPORTED)
      return true; // at its end, a read does not block either
    ahead = new ReadAhead;
    return ahead->waits();
  }
  if (is_terminal(Stream::In))
    return ::GetNumberOfConsoleInputEvents(in, &count) != 0 && count > 0;
  return true;
}

ssize_t read_input(std::span<char> bytes) {
  return ahead != nullptr ? ahead->read(bytes)
                          : ::_read(0, bytes.data(), static_cast<unsigned>(bytes.size()));
}

/// Bypasses the C library, which hands a console single bytes and so splits UTF-8 characters.
bool write_to(Stream stream, std::string_view text) {
  if (!is_terminal(stream)) {
    auto* const file = stream == Stream::Out ? stdout : stderr;
    return std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
  }
  constexpr std::size_t at_once = 8192; // bytes; a console takes no more than 64 KB
  const auto wide = in_utf16(text);
  for (std::wstring_view left = wide; !left.empty();) {
    const auto size = std::min(left.size(), at_once);
    DWORD written = 0;
    if (::WriteConsoleW(handle(stream), left.data(), static_cast<DWORD>(size), &written, nullptr) ==
        0) {
      errno = EIO;
      return false;
    }
    left.remove_prefix(written);
  }
  return true;
}

std::pair<std::size_t, std::size_t> screen() {
  constexpr std::size_t usual_rows = 24;
  constexpr std::size_t usual_columns = 80;
  CONSOLE_SCREEN_BUFFER_INFO info{};
  if (::GetConsoleScreenBufferInfo(handle(Stream::Err), &info) == 0)
    return {usual_rows, usual_columns};
  return {static_cast<std::size_t>(info.srWindow.Bottom - info.srWindow.Top + 1),
          static_cast<std::size_t>(info.srWindow.Right - info.srWindow.Left + 1)};
}

void end_if_unread(int error) {
  // The C library maps one kind of broken pipe to EPIPE and the others to EINVAL.
  if (error == EPIPE || (error == EINVAL && ::GetFileType(handle(Stream::Out)) == FILE_TYPE_PIPE))
    std::_Exit(ERROR_BROKEN_PIPE);
}

std::optional<std::string> make_temporary_folder() {
  std::error_code problem;
  const auto folder = std::filesystem::temp_directory_path(problem);
  constexpr int tries = 100;
  for (int i = 0; !problem && i < tries; ++i) {
    const auto own = folder / fmt::format("orb-{}-{}", ::GetCurrentProcessId(), i);
    if (std::filesystem::create_directory(own, problem))
      return own.string();
  }
  return std::nullopt;
}

} // namespace orb::cli
