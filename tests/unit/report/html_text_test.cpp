#include <gmock/gmock.h>

#include "analysis/report/page_style.h"

namespace osteomill {
namespace {

TEST(HtmlText, InjectsNoMarkup) {
    EXPECT_EQ(html_text("a<script>alert('x')</script>&\"b"),
              "a&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&amp;&quot;b");
    EXPECT_EQ(html_text("two\nlines\t\x7f"), "two lines  ");
    EXPECT_EQ(html_text("Größe"), "Größe");
    EXPECT_EQ(html_text("bad \xff\xfe byte"), "bad \xEF\xBF\xBD\xEF\xBF\xBD byte");
    EXPECT_EQ(html_text(""), "");
}

}  // namespace
}  // namespace osteomill
