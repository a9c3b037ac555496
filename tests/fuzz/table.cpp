#include "read/table.hpp"

#include "targets.hpp"

void chute::fuzz::table(std::string_view bytes) {
  const auto table = read::parse_table(bytes, "table.csv");
  for (const auto& name : table.header) {
    table.summary(name);
    if (table.is_number(name)) table.column(name);
  }
}
