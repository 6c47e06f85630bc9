#include "cli/terminal/watch.h"

#include "cli/terminal/interrupt.h"
#include "cli/terminal/watch_loop.h"
#include "disk/disk.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <system_error>
#include <windows.h>

#include <shellapi.h> // needs windows.h

namespace orb::cli {
namespace {

constexpr DWORD period_ms = 100;

/// Set in the child process of a watched command.
constexpr const wchar_t* mark = L"ORB_WATCHED_RUN";

/// Changes when a file is written, replaced or removed: existence, identity, size and time.
using Stamp = std::array<DWORD, 6>;

Stamp stamp(const std::string& path) {
  const auto file = ::CreateFileW(disk::as_path(path).c_str(), FILE_READ_ATTRIBUTES,
                                  FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr,
                                  OPEN_EXISTING, 0, nullptr);
  if (file == INVALID_HANDLE_VALUE)
    return {};
  BY_HANDLE_FILE_INFORMATION info{};
  ::GetFileInformationByHandle(file, &info);
  ::CloseHandle(file);
  return {1,
          info.nFileIndexHigh,
          info.nFileIndexLow,
          info.nFileSizeLow,
          info.ftLastWriteTime.dwHighDateTime,
          info.ftLastWriteTime.dwLowDateTime};
}

/// Quotes a word for CommandLineToArgvW(): backslashes are doubled only before a quote.
std::wstring quoted(const std::wstring& word) {
  std::wstring out = L"\"";
  std::size_t slashes = 0;
  for (const auto c : word) {
    if (c == L'"')
      out.append(slashes + 1, L'\\');
    slashes = c == L'\\' ? slashes + 1 : 0;
    out += c;
  }
  return out.append(slashes, L'\\') + L'"';
}

/// The command line of this process with `words` inserted among its options, before `--`.
std::wstring command_line(const std::vector<std::string>& words) {
  int count = 0;
  wchar_t** const given = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  std::vector<std::wstring> all(given, given + count);
  ::LocalFree(given);
  auto place = std::find(all.begin(), all.end(), L"--");
  for (const auto& word : words)
    place = std::next(all.insert(place, disk::as_path(word).wstring()));
  std::wstring line;
  for (const auto& word : all)
    line += (line.empty() ? L"" : L" ") + quoted(word);
  return line;
}

/// Makes a job, whose processes end together with this one in any case.
HANDLE make_job() {
  const auto job = ::CreateJobObjectW(nullptr, nullptr);
  JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
  limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
  ::SetInformationJobObject(job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
  return job;
}

/// Runs the command in a child process, one at a time.
class Runs {
public:
  Runs(Context& context, std::wstring line) : context_(context), line_(std::move(line)) {}
  ~Runs() {
    stop();
    ::CloseHandle(job_);
  }
  Runs(const Runs&) = delete;
  Runs& operator=(const Runs&) = delete;

  void start() {
    stop();
    std::array<wchar_t, 32768> program{}; // longest possible path
    ::GetModuleFileNameW(nullptr, program.data(), program.size());
    STARTUPINFOW start{};
    start.cb = sizeof start;
    start.dwFlags = STARTF_USESTDHANDLES;
    start.hStdInput = ::GetStdHandle(STD_INPUT_HANDLE);
    start.hStdOutput = ::GetStdHandle(STD_OUTPUT_HANDLE);
    start.hStdError = ::GetStdHandle(STD_ERROR_HANDLE);
    PROCESS_INFORMATION made{};
    auto line = line_; // CreateProcessW() modifies it
    ::SetEnvironmentVariableW(mark, L"1");
    const bool begun = ::CreateProcessW(program.data(), line.data(), nullptr, nullptr, TRUE,
                                        CREATE_SUSPENDED, nullptr, nullptr, &start, &made) != 0;
    const auto error = static_cast<int>(::GetLastError());
    ::SetEnvironmentVariableW(mark, nullptr);
    if (!begun) {
      print_error(context_, fmt::format("cannot start a run: {}; the next change tries again",
                                        std::system_category().message(error)));
      return;
    }
    ::AssignProcessToJobObject(job_, made.hProcess);
    ::ResumeThread(made.hThread);
    ::CloseHandle(made.hThread);
    process_ = made.hProcess;
  }

  RunEnd end() {
    if (process_ == nullptr || ::WaitForSingleObject(process_, 0) != WAIT_OBJECT_0)
      return RunEnd::NotYet;
    DWORD code = 0;
    ::GetExitCodeProcess(process_, &code);
    ::CloseHandle(process_);
    process_ = nullptr;
    return code == ERROR_BROKEN_PIPE ? RunEnd::ReaderGone : RunEnd::Finished;
  }

  bool interrupted() {
    ::Sleep(period_ms);
    return InterruptGuard::asked() > 0;
  }

private:
  void stop() {
    if (process_ == nullptr)
      return;
    ::TerminateProcess(process_, EXIT_FAILURE);
    ::WaitForSingleObject(process_, INFINITE);
    ::CloseHandle(process_);
    process_ = nullptr;
  }

  Context& context_;
  std::wstring line_;
  HANDLE job_ = make_job();
  HANDLE process_ = nullptr;
  InterruptGuard guard_;
};

} // namespace

void watch(Context& context, const std::function<std::vector<std::string>()>& list,
           const std::function<void()>& once, const std::function<void()>& ended,
           const std::vector<std::string>& words) {
  if (::GetEnvironmentVariableW(mark, nullptr, 0) != 0)
    return once();
  context.exit = ExitCode::Done;
  watch_with(Runs(context, command_line(words)), stamp, context, list, ended);
}

} // namespace orb::cli
