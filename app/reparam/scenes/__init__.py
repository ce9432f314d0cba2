"""Scenes: pictures as data. Typed parameters and nets in, frozen layers and claims out."""
