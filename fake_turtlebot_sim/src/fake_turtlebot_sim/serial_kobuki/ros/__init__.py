"""What a master sees of the Kobuki on a pseudo terminal."""
