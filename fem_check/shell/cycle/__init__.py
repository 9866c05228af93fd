"""Speed of a stiff sheet: static shapes over one period, then the friction balance."""
