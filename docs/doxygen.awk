# SPDX-License-Identifier: MIT
#
# Makes what doxygen reads of what the headers say: the // block at a file's head is about the file, the one before a
# declaration about that, one behind a member about the member. Indented by three blanks and more, it is a figure.
function flush_run(next_line, indent, i, text, figure, documents, file_head) {
    if (run == 0) return
    file_head = head && kept[1] ~ /SPDX/
    documents = next_line !~ /^ *$/ && next_line !~ /^ *(#|namespace|inline namespace|\}|public:|private:)/ &&
                (indent == "" || (in_type && indent == "    "))
    if (!file_head && !documents) {
        for (i = 1; i <= run; ++i) print kept[i]
    } else {
        print indent "/**" (file_head ? " \\file" : "")
        figure = 0
        for (i = file_head ? 2 : 1; i <= run; ++i) {
            text = kept[i]
            sub(/^ *\/\/ ?/, "", text)
            if (!figure && text ~ /^  /) { print "\\verbatim"; figure = 1 }
            if (figure && text !~ /^  / && text != "") { print "\\endverbatim"; figure = 0 }
            print figure ? text : escaped(text)
        }
        if (figure) print "\\endverbatim"
        print "*/"
    }
    run = 0
    head = 0
}
function escaped(text) {
    gsub(/[\\@<>&#%]/, "\\\\&", text)
    while (match(text, /`[^`]+`/))
        text = substr(text, 1, RSTART - 1) "<code>" substr(text, RSTART + 1, RLENGTH - 2) "</code>" \
               substr(text, RSTART + RLENGTH)
    return text
}
BEGIN { head = 1 }
# One version of the library stands in the reference, by its plain name.
/^inline namespace v0 \{$/ || /^\}  \/\/ namespace v0$/ { flush_run("", ""); print ""; next }
/^ *\/\// {
    match($0, /^ */)
    indent = substr($0, 1, RLENGTH)
    if (behind && length(indent) > 4) {
        sub(/\/\//, "///<")
        print substr($0, 1, index($0, "///<") + 3) escaped(substr($0, index($0, "///<") + 4))
        next
    }
    if (run > 0 && indent != run_indent) flush_run("", "")
    run_indent = indent
    kept[++run] = $0
    next
}
{
    flush_run($0, run_indent)
    behind = 0
    if ($0 ~ /^(struct|class|enum|union) / && $0 ~ /\{$/) in_type = 1
    if ($0 ~ /^\}/) in_type = 0
    if (in_type && $0 ~ /^    [^ ].*  \/\/ /) {
        at = index($0, "  // ")
        print substr($0, 1, at + 1) "///<" escaped(substr($0, at + 4))
        behind = 1
        next
    }
    print
}
END { flush_run("", "") }
