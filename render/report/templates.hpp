#pragma once

namespace chute::report {

/// The files of render/report/templates as text.
extern const char* const page_html;
extern const char* const page_css;
extern const char* const page_js;

}  // namespace chute::report
