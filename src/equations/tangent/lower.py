#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lowers the kernel to a `real` that is a struct. C has no operators on structs, so every + - * / on
a `real` becomes a call of an inline function that number_tangent.h defines.

  lower.py PREPROCESSED FOLDER OUTPUT

reads source.h as the preprocessor leaves it (line marks included), and writes what stems from files
in FOLDER. The types of all expressions are followed, so that integers keep their operators. What the
kernel has not needed so far is refused with file and line, not guessed at.
"""
import os
import sys

from pycparser import c_ast, c_generator, c_parser

# Operators on (left, right) and the functions they become.
OPERATIONS = {
    ("real", "+", "real"): "tangent_add",
    ("real", "-", "real"): "tangent_sub",
    ("real", "*", "real"): "tangent_mul",
    ("real", "/", "real"): "tangent_div",
    ("double", "-", "real"): "tangent_from",
    ("double", "*", "real"): "tangent_scale",
    ("double", "/", "real"): "tangent_over",
}
REAL, DOUBLE, INT = ("real",), ("double",), ("int",)
PLAIN = {"double": DOUBLE, "void": ("void",), "char": ("char",), "int": INT, "_Bool": INT}

# number_tangent.h defines this in a manner of its own; of the kernel's, the promise remains.
REPLACED = "solve_rear_angle"

HEAD = """\
// SPDX-License-Identifier: Apache-2.0
// The kernel on tangents: lower.py writes this from equations/kernel. Do not edit.
#ifndef BICYCLE_KERNEL_TANGENT_H
#define BICYCLE_KERNEL_TANGENT_H
#pragma GCC system_header

#include <bicycle/model.h>

"""


class Refused(Exception):
    pass


def refuse(node, why):
    """For a construct that the lowering does not know."""
    raise Refused(f"{node.coord}: {why}")


class Lowering:
    """Rewrites a syntax tree in place. A type is one of PLAIN, REAL, ("struct", name) or
    ("pointer", type); an array counts as a pointer to its elements."""

    def __init__(self):
        self.typedefs = {"real": REAL}
        self.structs = {}  # name: {member: type}
        self.functions = {}  # name: (type, [types of parameters])
        self.scopes = [{}]  # of names of values, file scope first
        self.result = None  # of the function at hand

    # Declarations

    def type_of(self, node):
        """The type that a declaration's type node means."""
        if isinstance(node, (c_ast.PtrDecl, c_ast.ArrayDecl)):
            return ("pointer", self.type_of(node.type))
        if isinstance(node, (c_ast.TypeDecl, c_ast.Typename)):
            return self.type_of(node.type)
        if isinstance(node, c_ast.IdentifierType):
            name = " ".join(node.names)
            return self.typedefs.get(name) or PLAIN.get(name) or refuse(node, f"type {name}")
        if isinstance(node, c_ast.Struct) and node.name:
            if node.decls is not None:
                self.structs[node.name] = {d.name: self.type_of(d.type) for d in node.decls}
            return ("struct", node.name)
        if isinstance(node, c_ast.Enum):
            self.scopes[0].update((entry.name, INT) for entry in node.values or [])
            return INT
        return refuse(node, f"a type made by {type(node).__name__}")

    def top(self, node):
        """One declaration or definition outside functions."""
        if isinstance(node, c_ast.Typedef):
            self.typedefs.setdefault(node.name, self.type_of(node.type))
        elif isinstance(node, c_ast.FuncDef):
            self.define(node)
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.FuncDecl):
            self.declare_function(node)
        elif isinstance(node, c_ast.Decl) and node.name is None:
            self.type_of(node.type)
        else:
            refuse(node, f"{type(node).__name__} outside functions")

    def declare_function(self, node):
        parameters = node.type.args.params if node.type.args else []
        kinds = [self.type_of(p.type) for p in parameters]
        self.functions[node.name] = (self.type_of(node.type.type), kinds)
        return {p.name: kind for p, kind in zip(parameters, kinds)}

    def define(self, node):
        self.scopes.append(self.declare_function(node.decl))
        self.result = self.functions[node.decl.name][0]
        self.on_Compound(node.body)
        self.scopes.pop()

    # Statements

    def statement(self, node):
        kind = type(node).__name__
        handler = self.value if kind == "FuncCall" else getattr(self, "on_" + kind, None)
        return handler(node) if handler else refuse(node, f"a statement {kind}")

    def on_Compound(self, node):
        self.scopes.append({})
        for item in node.block_items or []:
            self.statement(item)
        self.scopes.pop()

    def on_Decl(self, node):
        kind = self.type_of(node.type)
        if node.init is not None:
            node.init = self.initialiser(node.init, kind)
        self.scopes[-1][node.name] = kind

    def on_Return(self, node):
        node.expr = self.expected(node.expr, self.result)

    def on_If(self, node):
        """`if (pointer)`: whether there is something is known when compiling."""
        node.cond, kind = self.value(node.cond)
        if kind[0] != "pointer" or node.iffalse is not None:
            refuse(node, "an if on something else than a pointer, or with an else")
        self.statement(node.iftrue)

    def on_For(self, node):
        self.scopes.append({})
        for counter in node.init.decls:
            self.on_Decl(counter)
        node.cond = self.expected(node.cond, INT)
        node.next = self.expected(node.next, INT)
        self.statement(node.stmt)
        self.scopes.pop()

    def on_Assignment(self, node):
        node.lvalue, kind = self.value(node.lvalue)
        if node.op == "=":
            node.rvalue = self.expected(node.rvalue, kind)
        else:  # a += b becomes a = tangent_add(a, b)
            right = self.value(node.rvalue)
            node.rvalue = self.operation(node, node.op[:-1], (node.lvalue, kind), right)[0]
            node.op = "="

    # Expressions: each gives the new node and its type.

    def value(self, node):
        handler = getattr(self, "of_" + type(node).__name__, None)
        return handler(node) if handler else refuse(node, f"an expression {type(node).__name__}")

    def expected(self, node, kind):
        """An expression where `kind` is wanted: a plain number is no `real`."""
        lowered, found = self.value(node)
        return lowered if found == kind else refuse(node, f"{found} where {kind} is wanted")

    def initialiser(self, node, kind):
        if not isinstance(node, c_ast.InitList):
            return self.expected(node, kind)
        members = self.structs.get(kind[1]) if kind[0] == "struct" else None
        if members is None or len(node.exprs) != len(members):
            refuse(node, "a list that does not name every member of a struct in turn")
        node.exprs = [self.initialiser(e, k) for e, k in zip(node.exprs, members.values())]
        return node

    def of_ID(self, node):
        for scope in reversed(self.scopes):
            if node.name in scope:
                return node, scope[node.name]
        return refuse(node, f"{node.name} is not declared")

    def of_Constant(self, node):
        return node, PLAIN[node.type]

    def of_StructRef(self, node):
        node.name, base = self.value(node.name)
        if node.type == "->":
            base = base[1] if base[0] == "pointer" else refuse(node, "-> on no pointer")
        members = self.structs.get(base[1], {}) if base[0] == "struct" else {}
        member = members.get(node.field.name)
        return node, member or refuse(node, f"{base} has no member {node.field.name}")

    def of_ArrayRef(self, node):
        node.name, base = self.value(node.name)
        node.subscript = self.expected(node.subscript, INT)
        return node, base[1] if base[0] == "pointer" else refuse(node, "[] on no array")

    def of_CompoundLiteral(self, node):
        kind = self.type_of(node.type)
        node.init = self.initialiser(node.init, kind)
        return node, kind

    def of_FuncCall(self, node):
        name = getattr(node.name, "name", None)
        result, kinds = self.functions.get(name) or refuse(node, f"a call of unknown {name}")
        arguments = node.args.exprs if node.args else []
        if len(arguments) != len(kinds):
            refuse(node, f"{name} takes {len(kinds)} arguments")
        node.args.exprs = [self.expected(a, k) for a, k in zip(arguments, kinds)]
        return node, result

    def of_UnaryOp(self, node):
        node.expr, kind = self.value(node.expr)
        if node.op == "&":
            return node, ("pointer", kind)
        if node.op == "*" and kind[0] == "pointer":
            return node, kind[1]
        if node.op == "-" and kind == REAL:
            return self.made("tangent_neg", node, node.expr), REAL
        if node.op == "-" and kind == DOUBLE or node.op in ("p++", "++") and kind == INT:
            return node, kind
        return refuse(node, f"{node.op} on {kind}")

    def of_BinaryOp(self, node):
        return self.operation(node, node.op, self.value(node.left), self.value(node.right))

    def operation(self, node, operator, left, right):
        kinds = (left[1][0], operator, right[1][0])
        if kinds in OPERATIONS:
            return self.made(OPERATIONS[kinds], node, left[0], right[0]), REAL
        if kinds == ("int", "<", "int"):
            return node, INT
        return refuse(node, f"{' '.join(kinds)} is not among the operations")

    @staticmethod
    def made(name, node, *arguments):
        return c_ast.FuncCall(c_ast.ID(name), c_ast.ExprList(list(arguments)), node.coord)


def shown(node, generator):
    """A lowered declaration as C."""
    if not isinstance(node, c_ast.FuncDef):
        return generator.visit(node) + ";\n"
    replaced = node.decl.name == REPLACED
    text = generator.visit(node.decl) + ";\n" if replaced else generator.visit(node)
    return text.replace("inline static", "LANE_INLINE")


def lowered(text, folder):
    """The declarations of the files in `folder`, lowered."""
    lowering, generator, parts = Lowering(), c_generator.CGenerator(), []
    for node in c_parser.CParser().parse(text).ext:
        lowering.top(node)
        if os.path.realpath(node.coord.file).startswith(os.path.realpath(folder) + os.sep):
            parts.append(shown(node, generator))
    return HEAD + "\n".join(parts) + "\n#endif\n"


def main(arguments):
    if len(arguments) != 3:
        sys.exit("usage: lower.py PREPROCESSED FOLDER OUTPUT")
    source, folder, output = arguments
    try:
        with open(source, encoding="utf-8") as file:
            text = lowered(file.read(), folder)
        with open(output, "w", encoding="utf-8") as file:
            file.write(text)
    except (OSError, Refused, c_parser.ParseError) as error:
        sys.exit(f"lower.py: {error}")


if __name__ == "__main__":
    main(sys.argv[1:])
