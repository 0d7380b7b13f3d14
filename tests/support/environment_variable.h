#pragma once

#include <cstdlib>
#include <string>

namespace tubesight::support {

/// A variable of the environment, of this process and of those that it starts, for as long as this
/// lives. Unset afterwards, whatever it was before.
class EnvironmentVariable {
 public:
  EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
    setenv(name, value.c_str(), 1);
  }
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;
  ~EnvironmentVariable() { unsetenv(name_); }

 private:
  const char* name_;
};

}  // namespace tubesight::support
