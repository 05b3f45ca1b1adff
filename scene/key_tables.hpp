// The tables of keys in docs/reference/scene-file.md, made from the records.
#pragma once

#include <string>

namespace undex::scene {

/// The page with what stands between its marks replaced:
///   <!-- table: scheme -->   ... <!-- end -->   the keys of [scheme]
///   <!-- tables: shape -->   ... <!-- end -->   every shape with what it is and its keys
/// Throws FileError where a mark names no table or has no end; `file` is what the message calls the page.
std::string with_key_tables(const std::string& page, const std::string& file);

}  // namespace undex::scene
