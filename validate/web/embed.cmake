# SPDX-License-Identifier: Apache-2.0
# Turns text files into a C source: cmake -DOUT=x.c -DNAME=symbol -DFILES=a;b -P embed.cmake joins
# the files into one zero-terminated array. A reference to a source map is left out: a page that
# opens without a network must not name a file that is not there.
set(text "")
foreach(file IN LISTS FILES)
  file(READ ${file} hex HEX)
  string(APPEND text "${hex}")
  # A script that ends without a line feed would swallow the first line of the next.
  string(APPEND text "0a")
endforeach()
# "//# sourceMappingURL=" to the end of its line, at a byte boundary
string(REGEX REPLACE "2f2f2320736f757263654d617070696e6755524c3d([1-9a-f][0-9a-f]|0[0-9b-f])*" "" text
  "${text}")
string(REGEX REPLACE "(................................................................)" "\\1\n"
  text "${text}")
# As octal escapes would be, but without the question of what a char above 127 is worth.
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," text "${text}")
file(WRITE ${OUT}
  "/* Made by embed.cmake. */\nextern const char ${NAME}[];\nconst char ${NAME}[] = {\n${text}0};\n")
