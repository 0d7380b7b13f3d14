#include "drivers/web/page_files.h"

#include <gtest/gtest.h>

#include "drivers/web/embedded_files.h"

namespace tubesight::drivers {
namespace {

TEST(PageFiles, HaveThePage) {
  const auto page = page_file("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->type, "text/html; charset=utf-8");
  EXPECT_TRUE(page->bytes.starts_with("<!")) << page->bytes.substr(0, 20);
}

TEST(PageFiles, AreAllThere) {
  for (const EmbeddedFile& file : embedded_files()) {
    const auto found = page_file("/page/" + std::string(file.name));
    ASSERT_TRUE(found) << file.name;
    EXPECT_EQ(found->bytes.data(), file.bytes.data());
    EXPECT_NE(found->type, "application/octet-stream") << file.name;
  }
}

TEST(PageFiles, LeadNowhereElse) {
  for (const char* const path : {"", "/page/", "/page/../index.html", "/page//index.html",
                                 "/index.html", "/etc/passwd", "/page/%2e%2e/x"}) {
    EXPECT_FALSE(page_file(path)) << path;
  }
}

}  // namespace
}  // namespace tubesight::drivers
