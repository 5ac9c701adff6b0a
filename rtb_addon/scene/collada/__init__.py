"""Collada 1.4.1: each part of the format read, and each written, by a module of its own."""
