#include "base/error.hpp"

#include <fmt/format.h>

namespace gannet {

namespace {
std::string join_lines(const std::vector<std::string>& lines) {
  return fmt::format("{}", fmt::join(lines, "\n"));
}
}  // namespace

std::string Location::text() const {
  if (line <= 0) return file;
  if (column <= 0) return fmt::format("{}:{}", file, line);
  return fmt::format("{}:{}:{}", file, line, column);
}

InputError::InputError(std::vector<std::string> messages)
    : std::runtime_error(join_lines(messages)), messages_(std::move(messages)) {}

InputError::InputError(const std::string& message)
    : InputError(std::vector<std::string>{message}) {}

InputError::InputError(const Location& where, const std::string& what)
    : InputError(where.text() + ": " + what) {}

RunError::RunError(RunFailure failure)
    : std::runtime_error(fmt::format("{}\n  where: {}\n  why:   {}\n  try:   {}", failure.what,
                                     failure.where, failure.why, failure.try_this)),
      failure_(std::move(failure)) {}

}  // namespace gannet
