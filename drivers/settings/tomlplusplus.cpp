// Compiles toml++ itself.
#define TOML_IMPLEMENTATION

#include "drivers/settings/tomlplusplus.h"
