"""A scene as Mitsuba's XML: each kind of thing written by a module of its own."""
